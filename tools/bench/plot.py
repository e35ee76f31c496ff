"""Bars as SVG, by the standard library alone."""
from html import escape

COLOURS = ("#2f6f9f", "#c8782e", "#6b9a4b", "#8a5fa0")
LEFT, RIGHT, BAR, GAP, TOP, WIDTH = 190, 70, 13, 10, 56, 760


def text(x, y, words, anchor="start", size=12, weight="normal"):
    return (f'<text x="{x:.0f}" y="{y:.0f}" font-size="{size}" text-anchor="{anchor}" font-weight="{weight}">'
            f"{escape(words)}</text>")


def bars(title, note, groups, series, marked=None):
    """`groups`: (name, values, one a series: None, a number, or (low, middle, high)). A line at the value `marked`."""
    middles = [v if isinstance(v, (int, float)) else v[1] for _, values in groups for v in values if v is not None]
    highs = [v[2] for _, values in groups for v in values if isinstance(v, tuple)]
    scale = (WIDTH - LEFT - RIGHT) / max(middles + highs + [marked or 0])
    lines, y = [], TOP
    for name, values in groups:
        lines.append(text(LEFT - 8, y + BAR * len(values) / 2 + 4, name, "end"))
        for colour, value in zip(COLOURS, values):
            if value is not None:
                low, middle, high = value if isinstance(value, tuple) else (value, value, value)
                lines.append(f'<rect x="{LEFT}" y="{y}" width="{middle * scale:.1f}" height="{BAR - 2}" fill="{colour}"/>')
                if high > low:
                    lines.append(f'<path d="M{LEFT + low * scale:.1f} {y + 5.5}H{LEFT + high * scale:.1f}" stroke="#222"/>')
                lines.append(text(LEFT + max(middle, high) * scale + 5, y + 10, f"{middle:.2f}", size=11))
            y += BAR
        y += GAP
    if marked is not None:
        x = LEFT + marked * scale
        lines.append(f'<path d="M{x:.1f} {TOP - 6}V{y}" stroke="#222" stroke-dasharray="4 3"/>')
    key, x = [], LEFT
    for colour, name in zip(COLOURS, series):
        key.append(f'<rect x="{x}" y="{TOP - 22}" width="11" height="11" fill="{colour}"/>' + text(x + 16, TOP - 12, name))
        x += 26 + 8 * len(name)
    body = "\n".join([text(10, 20, title, size=14, weight="bold"), *key, *lines, text(10, y + 14, note, size=10)])
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y + 24}" font-family="sans-serif" fill="#222">\n'
            f'<rect width="{WIDTH}" height="{y + 24}" fill="#fff"/>\n{body}\n</svg>\n')
