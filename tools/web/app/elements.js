// What the page is made of: elements with their texts, and with what they do.

export function make(tag, name, text) {
  const element = document.createElement(tag);
  if (name) element.className = name;
  if (text !== undefined) element.textContent = text;
  return element;
}

// A link that does something in the page.
export function link(text, href, act, title) {
  const one = make('a', '', text);
  one.href = href;
  if (title) one.title = title;
  one.onclick = event => { event.preventDefault(); act(); };
  return one;
}

export function button(text, act, title) {
  const element = make('button', '', text);
  element.type = 'button';
  if (title) element.title = title;
  element.onclick = act;
  return element;
}

// A button that is only a sign, which the label reads out.
export function iconButton(sign, act, label, name = '') {
  const element = button(sign, act, label);
  element.className = ('icon ' + name).trim();
  element.setAttribute('aria-label', label);
  return element;
}

// `choices`: [value, text].
export function select(label, choices, chosen) {
  const box = make('select');
  box.setAttribute('aria-label', label);
  for (const [value, text] of choices) {
    const option = make('option', '', text);
    option.value = value;
    option.selected = value === chosen;
    box.append(option);
  }
  return box;
}

// A table without rows. `heads`: [class of the column, what is in its head].
export function tableOf(heads, caption) {
  const table = make('table'), row = make('tr'), head = make('thead'), rows = make('tbody');
  if (caption) table.append(make('caption', '', caption));
  for (const [name, content] of heads) {
    const cell = make('th', name);
    cell.append(content);
    cell.scope = 'col';
    row.append(cell);
  }
  head.append(row);
  table.append(head, rows);
  return {table, rows, heads: [...row.children]};
}
