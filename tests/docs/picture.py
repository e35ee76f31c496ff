"""Some rungs of a page that `rungc view` or `rungc test --coverage-html` has written, as one picture for the README."""
import re

MARGIN = 16
CAPTION = 26
GAP = 14
HEADING = 40


def style_of(page):
    """The page's rules for drawings, in the colours of a light screen."""
    colours = dict(re.findall(r"--(\w+):(#\w+)", page.split("}", 1)[0]))
    rules = re.search(r"^path \{.*?(?=/\* On paper)", page, re.MULTILINE | re.DOTALL).group()
    return re.sub(r"var\(--(\w+)\)", lambda match: colours[match[1]], rules)


def figure_of(page, rung):
    """(width, height, caption, drawing) of a rung."""
    figure = re.search(rf'<figure class="[^"]*" id="r{rung}">(.*?)</figure>', page, re.DOTALL).group(1)
    caption, drawing = re.fullmatch(r"<figcaption>(.*?)</figcaption><svg [^>]*>(.*?)</svg>", figure, re.DOTALL).groups()
    width, height = map(int, re.search(r'<svg [^>]*width="(\d+)" height="(\d+)"', figure).groups())
    return width, height, caption, re.sub(r' href="[^"]*"', "", drawing)


def caption_of(caption, width):
    """Number and title at the left, the source line and how often the rung ran at the right."""
    def part(pattern):
        found = re.search(pattern, caption)
        return found.group(1) if found else ""
    right = [text for text in (part(r'<i class="o">(.*?)</i>'), part(r'class="f"[^>]*>(.*?)</')) if text]
    return (f'<text class="k" y="14">{part("<b>(.*?)</b>")}</text><text class="k" x="32" y="14">{part("<span>(.*?)</span>")}</text>'
            f'<text class="f ae" x="{width}" y="14">{" · ".join(right)}</text>')


def picture(page, rungs):
    title = re.search(r"<h1>(.*?)</h1>", page).group(1)
    parts, y, widest = [], HEADING, 0
    for width, height, caption, drawing in (figure_of(page, rung) for rung in rungs):
        parts.append(f'<g transform="translate({MARGIN} {y})">{caption_of(caption, width)}<g transform="translate(0 {CAPTION})">{drawing}</g></g>\n')
        y += CAPTION + height + GAP
        widest = max(widest, width)
    size = f"{widest + 2 * MARGIN} {y + MARGIN - GAP}"
    width, height = size.split()
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {size}" role="img">\n<title>{title}</title>\n'
            f'<style>\n{style_of(page)}</style>\n<rect width="{width}" height="{height}" fill="#fff"/>\n'
            f'<text class="M" x="{MARGIN}" y="28">{title}</text>\n{"".join(parts)}</svg>\n')
