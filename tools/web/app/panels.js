// Lists of names: those that are watched, inputs and outputs; and the name that is selected.
import {button, iconButton, link, make, select, tableOf} from './elements.js';
import {get, post} from './link.js';

// Rungs as links that lead to them; go(rung).
export function rungLinks(rungs, go, most = 40) {
  const span = make('span', 'rungs');
  rungs.slice(0, most).forEach((rung, i) => span.append(i ? ', ' : '', link(rung, '#r' + rung, () => go(rung))));
  if (rungs.length > most) span.append(` and ${rungs.length - most} more`);
  return span;
}

// Who writes the name, and who reads it; go(rung, {id, writes}) leads to the name in it.
function usesOf(known, go, most) {
  const of = (rungs, writes, machine) => rungs.length ? rungLinks(rungs, rung => go(rung, {id: known.id, writes}), most)
    : make('span', 'soft', machine ? 'machine' : 'no rung');
  return {writes: of(known.writes, true, known.kind === 'i'), reads: of(known.reads, false, known.kind === 'o')};
}

// Orders that write. They are sent only while writing is switched on.
export class Writer {
  constructor(tell) {
    this.on = false;
    this.tell = tell;
  }
  async send(order) {
    try {
      const answer = await post('order', {...order, writing: this.on});
      this.tell('Done: ' + answer.done);
      return true;
    } catch (error) {
      this.tell(error.message, true);
      return false;
    }
  }
}

// Set, force and release for one name.
export function writeControls(name, writer, current) {
  const box = make('form', 'write');
  const input = make('input');
  input.setAttribute('aria-label', `New value of ${name}`);
  input.placeholder = 'value';
  input.value = current === '0' ? '1' : current === '1' ? '0' : '';
  const send = what => event => { event.preventDefault(); writer.send({do: what, name, value: input.value.trim()}); };
  const set = make('button', '', 'Set');
  set.type = 'submit';
  box.onsubmit = send('set');
  box.append(input, set, button('Force', send('force'), 'The program sees this value until it is released'),
    button('Release', () => writer.send({do: 'unforce', name})));
  return box;
}

// What decided in a step: [name, value, rows of the name, whether it decided alone].
const causeText = ([name, value, , alone]) => name + (value ? ` = ${value}` : '') + (alone ? ' (alone)' : '');

// The name that is selected: what it is, its value, where it is used, and why.
export class Detail {
  // `act`: go(rung, place), goRow(row), seek(scan), watch(name), causes(map of rows to what decided in them),
  // back(): the focus goes to the rungs.
  constructor(box, names, writer, act) {
    Object.assign(this, {box, names, writer, act, name: ''});
  }

  async show(element) {
    const label = element.dataset.name ?? '';
    await this.names.load();
    const known = element.dataset.id !== undefined ? this.names.byId.get(Number(element.dataset.id)) : null;
    this.known = known;
    this.act.causes(new Map());
    this.name = known && known.kind !== 't' ? known.name : '';
    this.fill(label, known);
    this.box.hidden = false;
  }

  fill(label, known) {
    const title = make('h2', '', known ? known.name : label);
    const head = make('div', 'head');
    head.append(title, iconButton('×', () => this.close(), 'Close', 'close'));
    this.box.replaceChildren(head);
    if (!known) return;
    if (known.address) this.box.append(make('p', 'addr', known.address));
    if (known.comment) this.box.append(make('p', '', known.comment));
    if (known.kind !== 't' && known.kind !== 'c') {
      this.value = make('output', 'value', '…');
      this.value.setAttribute('aria-label', 'Value');
      this.box.append(this.value);
    }
    const uses = make('dl'), {writes, reads} = usesOf(known, this.act.go);
    for (const [what, rungs] of [['Written in', writes], ['Read in', reads]]) {
      const cell = make('dd');
      cell.append(rungs);
      uses.append(make('dt', '', what), cell);
    }
    if (known.shapes.length) uses.append(make('dt', '', 'Drawn as'), shapesOf(known, 'dd'));
    this.box.append(uses);
    const actions = make('div', 'actions');
    if (this.name) {
      actions.append(button('Why?', () => this.why(), 'Which rungs and inputs lead to this value'),
        button('Watch', () => this.act.watch(this.name), 'Add to the watch list ( w )'));
      this.box.append(actions);
      this.controls = make('div');
      this.box.append(this.controls);
      this.reason = make('div', 'why');
      this.reason.setAttribute('role', 'region');
      this.reason.setAttribute('aria-label', 'Why');
      this.reason.hidden = true;
      this.box.append(this.reason);
      this.offered = null;
    }
  }

  async why() {
    this.reason.hidden = false;
    this.reason.textContent = '…';
    try {
      const answer = await get('why?name=' + encodeURIComponent(this.name));
      this.reason.replaceChildren();
      this.act.causes(new Map(answer.steps.filter(step => step[3] !== null).map(step => [step[3], step[4]])));
      if (answer.steps.length) return this.fillSteps(answer);
      this.fillText(answer.why);
    } catch (error) {
      this.reason.textContent = error.message;
    }
  }

  // Rungs in the text lead to them.
  fillText(why) {
    const text = make('pre');
    for (const part of why.split(/(rung \d+)/)) {
      const rung = /^rung (\d+)$/.exec(part);
      if (rung) text.append('rung ', rungLinks([Number(rung[1])], this.act.go)); else text.append(part);
    }
    this.reason.append(text);
  }

  // Each step with its scan, its rung, and what decided in it; that is marked in the drawing, too.
  fillSteps({steps, different, skipped}) {
    const chain = make('div');
    this.reason.append(chain);
    for (const [depth, text, scan, row, causes] of steps) {
      const line = make('div', 'step');
      line.style.marginLeft = Math.min(depth, 6) * 10 + 'px';
      line.append(row === null ? text : link(text, '#row' + row, () => this.act.goRow(row), 'Show the rung'), ' since ',
        link(`scan ${scan}`, '#scan' + scan, () => this.act.seek(scan), 'Go back to this scan'));
      if (causes.length) line.append(make('div', 'soft', 'decided by ' + causes.map(causeText).join(', ')));
      chain.append(line);
    }
    for (const text of skipped) this.reason.append(make('div', 'soft', text));
    if (different.length) this.reason.append(make('div', 'different', 'It would be different with ' + different.join(' and ')));
  }

  draw(picture) {
    if (this.box.hidden || !this.name || !this.value) return;
    const value = picture.values[this.name] ?? '';
    const forced = picture.forces.find(cell => cell.name === this.name || (this.known && cell.ids.includes(this.known.id)));
    const text = value + (forced ? ' (forced)' : '');
    if (this.value.textContent !== text) this.value.textContent = text;
    this.value.classList.toggle('is-forced', Boolean(forced));
    if (this.offered !== this.writer.on) {
      this.offered = this.writer.on;
      this.controls.replaceChildren(...(this.writer.on ? [writeControls(this.name, this.writer, value)] : []));
    }
  }

  close() {
    const hadFocus = this.box.contains(document.activeElement);
    this.box.hidden = true;
    this.name = '';
    this.act.causes(new Map());
    if (hadFocus) this.act.back();
  }
}

// Names whose values are shown in a table: the watch list, and inputs and outputs.
class NameTable {
  constructor(label, heads) {
    this.cells = new Map();
    Object.assign(this, tableOf(heads));
    this.table.setAttribute('aria-label', label);
  }
  draw(picture) {
    const forced = new Set(picture.forces.flatMap(cell => cell.ids));
    for (const [name, [cell, id]] of this.cells) {
      const value = picture.values[name];
      if (value !== undefined && cell.textContent !== value) cell.textContent = value;
      cell.classList.toggle('on', value === '1');
      cell.classList.toggle('is-forced', forced.has(id));
    }
  }
}

// How the program draws the name: what it does while the terminal has no voltage can be seen there.
const kShapes = {'| |': 'normally open contact', '|/|': 'normally closed contact', '|P|': 'contact of the rising edge',
  '|N|': 'contact of the falling edge', '( )': 'coil', '(/)': 'inverted coil', '(S)': 'set coil', '(R)': 'reset coil'};
function shapesOf(known, tag) {
  const cell = make(tag, 'num shapes', known.shapes.join(', '));
  cell.title = known.shapes.map(shape => kShapes[shape] ?? shape).join(', ');
  cell.setAttribute('aria-label', cell.title);
  return cell;
}

export class Watch {
  constructor(box, names, writer, choose, key) {
    Object.assign(this, {box, names, writer, choose, key});
    try { this.list = JSON.parse(localStorage.getItem(key) ?? '[]'); } catch { this.list = []; }
    this.table = new NameTable('Watched names', [['', 'Name'], ['', 'Address'], ['', 'Value'], ['about', 'Comment'], ['act', '']]);
    const form = make('form', 'add');
    const input = make('input');
    input.placeholder = 'Name or address';
    input.setAttribute('aria-label', 'Name to watch');
    form.append(input, make('button', '', 'Watch'));
    form.onsubmit = event => { event.preventDefault(); if (input.value.trim()) this.add(input.value.trim()); input.value = ''; };
    this.empty = make('p', 'soft', 'Nothing is watched. Click a contact, a coil or a name in the rungs and choose Watch.');
    box.append(form, this.empty, this.table.table);
  }

  add(name) {
    if (!this.list.includes(name)) this.list.push(name);
    this.save();
  }

  remove(name) {
    this.list = this.list.filter(one => one !== name);
    this.save();
  }

  save() {
    try { localStorage.setItem(this.key, JSON.stringify(this.list)); } catch { /* it lasts as long as the page */ }
    this.fill();
    this.onchange?.();
  }

  async fill() {
    await this.names.load();
    this.writing = this.writer.on;
    this.empty.hidden = this.list.length > 0;
    this.table.table.hidden = !this.list.length;
    this.table.cells.clear();
    this.table.rows.replaceChildren(...this.list.map(name => {
      const known = this.names.byName.get(name);
      const row = make('tr'), head = make('th', '', name), value = make('td', 'value'), last = make('td', 'act');
      head.scope = 'row';
      last.append(iconButton('×', () => this.remove(name), `Remove ${name}`, 'close'));
      if (this.writing) last.prepend(writeControls(name, this.writer));
      if (known) head.replaceChildren(link(name, '#n' + known.id, () => this.choose({dataset: {id: known.id, name}})));
      row.append(head, make('td', 'addr', known?.address ?? ''), value, make('td', 'about', known?.comment ?? ''), last);
      this.table.cells.set(name, [value, known?.id]);
      return row;
    }));
  }

  follows() { return this.list; }
  draw(picture) {
    if (this.writing !== this.writer.on) this.fill();
    this.table.draw(picture);
  }
}

const kIoRow = 31;  // height of a row in pixels, as in app.css

// Columns of the inputs and outputs: class, head, and what a row is sorted by; addresses and names by the numbers in them.
const kColumns = [['kind', '', one => one.kind], ['address', 'Address', one => one.address], ['name', 'Name', one => one.name],
  ['now', 'Value'], ['drawn', 'Drawn as', one => one.shapes.join()], ['uses', 'Written in', one => one.writes[0] ?? 0],
  ['uses', 'Read in', one => one.reads[0] ?? 0], ['about', 'Comment', one => one.comment]];
const inOrder = new Intl.Collator(undefined, {numeric: true}).compare;

// Inputs and outputs; only rows that are seen are followed.
export class Terminals {
  constructor(box, names, go, choose) {
    Object.assign(this, {box, names, go, choose});
    this.sorted = {column: -1, back: false};
    this.table = new NameTable('Inputs and outputs', kColumns.map(([name, text, by], i) => [name, by ? this.sortButton(text, i) : text]));
    const bar = make('div', 'add');
    this.filter = make('input');
    this.filter.type = 'search';
    this.filter.placeholder = 'Filter';
    this.filter.setAttribute('aria-label', 'Filter inputs and outputs');
    this.filter.oninput = () => this.fill();
    this.kind = select('Which', [['io', 'Inputs and outputs'], ['i', 'Inputs'], ['o', 'Outputs']], 'io');
    this.kind.onchange = () => this.fill();
    this.count = make('span', 'soft');
    bar.append(this.filter, this.kind, this.count);
    box.append(bar, this.table.table);
    box.addEventListener('scroll', () => this.onchange?.(), {passive: true});
  }

  sortButton(text, column) {
    const one = button(text || '↕', () => this.sort(column), `Sort by ${text ? text.toLowerCase() : 'input or output'}`);
    one.setAttribute('aria-label', one.title);
    return one;
  }

  // The same column once more: backwards.
  sort(column) {
    this.sorted = {column, back: this.sorted.column === column && !this.sorted.back};
    this.table.heads.forEach((head, i) => {
      if (i === column) head.setAttribute('aria-sort', this.sorted.back ? 'descending' : 'ascending'); else head.removeAttribute('aria-sort');
    });
    this.fill();
  }

  inTheirOrder(list) {
    const by = kColumns[this.sorted.column]?.[2];
    if (!by) return list;
    list.sort((a, b) => inOrder(by(a), by(b)));
    return this.sorted.back ? list.reverse() : list;
  }

  async fill() {
    await this.names.load();
    const key = this.filter.value.trim().toLowerCase();
    this.list = this.inTheirOrder(this.names.all.filter(one => one.kind && this.kind.value.includes(one.kind) && one.key.includes(key)));
    this.count.textContent = this.list.length === 1 ? '1 name' : `${this.list.length} names`;
    this.table.cells.clear();
    this.table.rows.replaceChildren(...this.list.map(one => this.row(one)));
    this.onchange?.();
  }

  row(one) {
    const row = make('tr'), name = make('th'), value = make('td', 'value'), uses = usesOf(one, this.go, 6);
    name.scope = 'row';
    name.append(link(one.name, '#n' + one.id, () => this.choose({dataset: {id: one.id, name: one.name}}), one.name));
    const writes = make('td'), reads = make('td'), about = make('td', 'about', one.comment);
    about.title = one.comment;
    writes.append(uses.writes);
    reads.append(uses.reads);
    row.append(make('td', 'soft', one.kind === 'i' ? 'in' : 'out'), make('td', 'addr', one.address), name, value, shapesOf(one, 'td'),
      writes, reads, about);
    this.table.cells.set(one.name, [value, one.id]);
    return row;
  }

  follows() {
    if (!this.list) return [];
    const first = Math.max(0, Math.floor(this.box.scrollTop / kIoRow) - 4);
    return this.list.slice(first, first + Math.ceil(this.box.clientHeight / kIoRow) + 8).map(one => one.name);
  }
  draw(picture) { this.table.draw(picture); }
}
