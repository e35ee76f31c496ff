// The other views: watched names, inputs and outputs, history, and the name that is selected.
import {get, post} from './link.js';

export function make(tag, name, text) {
  const element = document.createElement(tag);
  if (name) element.className = name;
  if (text !== undefined) element.textContent = text;
  return element;
}

function button(text, act, title) {
  const element = make('button', '', text);
  element.type = 'button';
  if (title) element.title = title;
  element.onclick = act;
  return element;
}

// Rungs as links that lead to them.
function rungLinks(rungs, go, most = 40) {
  const span = make('span', 'rungs');
  rungs.slice(0, most).forEach((rung, i) => {
    if (i) span.append(', ');
    const link = make('a', '', rung);
    link.href = '#r' + rung;
    link.onclick = event => { event.preventDefault(); go(rung); };
    span.append(link);
  });
  if (rungs.length > most) span.append(` and ${rungs.length - most} more`);
  return span;
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

// The name that is selected: what it is, its value, where it is used, and why.
export class Detail {
  // `act`: go(rung), goRow(row), seek(scan), watch(name), causes(map of rows to the names that decided in them).
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
    const close = button('×', () => this.close(), 'Close ( Esc )');
    close.className = 'icon close';
    close.setAttribute('aria-label', 'Close');
    const head = make('div', 'head');
    head.append(title, close);
    this.box.replaceChildren(head);
    if (!known) return;
    if (known.address) this.box.append(make('p', 'addr', known.address));
    if (known.comment) this.box.append(make('p', '', known.comment));
    if (known.kind !== 't' && known.kind !== 'c') {
      this.value = make('output', 'value', '…');
      this.value.setAttribute('aria-label', 'Value');
      this.box.append(this.value);
    }
    const uses = make('dl');
    const row = (what, rungs, machine) => {
      uses.append(make('dt', '', what));
      const cell = make('dd');
      cell.append(rungs.length ? rungLinks(rungs, this.act.go) : make('span', 'soft', machine ? 'machine' : 'no rung'));
      uses.append(cell);
    };
    row('Written in', known.writes, known.kind === 'i');
    row('Read in', known.reads, known.kind === 'o');
    this.box.append(uses);
    const actions = make('div', 'actions');
    if (this.name) {
      actions.append(button('Why?', () => this.why(), 'Which rungs and inputs lead to this value'),
        button('Watch', () => this.act.watch(this.name), 'Add to the watch list ( w )'));
      this.box.append(actions);
      this.controls = make('div');
      this.box.append(this.controls);
      this.reason = make('pre', 'why');
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
      if (answer.steps.length) return this.fillSteps(answer.steps);
      // Rungs in the text lead to them.
      for (const part of answer.why.split(/(rung \d+)/)) {
        const rung = /^rung (\d+)$/.exec(part);
        if (rung) this.reason.append(rungLinks([Number(rung[1])], this.act.go)); else this.reason.append(part);
        if (rung) this.reason.lastChild.prepend('rung ');
      }
    } catch (error) {
      this.reason.textContent = error.message;
    }
  }

  // Each step with its scan, its rung, and what decided in it; that is marked in the drawing, too.
  fillSteps(steps) {
    for (const [depth, text, scan, row, causes] of steps) {
      const line = make('div', 'step');
      line.style.marginLeft = Math.min(depth, 6) * 10 + 'px';
      const link = (label, act, title) => {
        const one = make('a', '', label);
        one.href = '#why';
        one.title = title;
        one.onclick = event => { event.preventDefault(); act(); };
        return one;
      };
      line.append(row === null ? text : link(text, () => this.act.goRow(row), 'Show the rung'), ' since ',
        link(`scan ${scan}`, () => this.act.seek(scan), 'Go back to this scan'));
      if (causes.length) line.append(make('div', 'soft', 'decided by ' + causes.join(', ')));
      this.reason.append(line);
    }
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
    this.box.hidden = true;
    this.name = '';
    this.act.causes(new Map());
  }
}

// Names whose values are shown in a table: the watch list, and inputs and outputs.
class NameTable {
  constructor(box, heads) {
    this.box = box;
    this.cells = new Map();
    this.table = make('table');
    const head = make('tr');
    for (const text of heads) {
      const cell = make('th', '', text);
      cell.scope = 'col';
      head.append(cell);
    }
    const top = make('thead');
    top.append(head);
    this.rows = make('tbody');
    this.table.append(top, this.rows);
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

export class Watch {
  constructor(box, names, writer, go, key) {
    Object.assign(this, {box, names, writer, go, key});
    try { this.list = JSON.parse(localStorage.getItem(key) ?? '[]'); } catch { this.list = []; }
    this.table = new NameTable(box, ['Name', 'Address', 'Value', 'Comment', '']);
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
      last.append(button('Remove', () => this.remove(name)));
      if (this.writing) last.prepend(writeControls(name, this.writer));
      row.append(head, make('td', 'addr', known?.address ?? ''), value, make('td', '', known?.comment ?? ''), last);
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

// Inputs and outputs; only rows that are seen are followed.
export class Terminals {
  constructor(box, names, go, choose) {
    Object.assign(this, {box, names, go, choose});
    this.table = new NameTable(box, ['', 'Address', 'Name', 'Value', 'Comment', 'Written in', 'Read in']);
    const bar = make('div', 'add');
    this.filter = make('input');
    this.filter.type = 'search';
    this.filter.placeholder = 'Filter';
    this.filter.setAttribute('aria-label', 'Filter inputs and outputs');
    this.filter.oninput = () => this.fill();
    this.kind = make('select');
    this.kind.setAttribute('aria-label', 'Which');
    for (const [value, text] of [['io', 'Inputs and outputs'], ['i', 'Inputs'], ['o', 'Outputs']]) {
      const option = make('option', '', text);
      option.value = value;
      this.kind.append(option);
    }
    this.kind.onchange = () => this.fill();
    this.count = make('span', 'soft');
    bar.append(this.filter, this.kind, this.count);
    box.append(bar, this.table.table);
    box.addEventListener('scroll', () => this.onchange?.(), {passive: true});
  }

  async fill() {
    await this.names.load();
    const key = this.filter.value.trim().toLowerCase();
    this.list = this.names.all.filter(one => one.kind && this.kind.value.includes(one.kind) && one.key.includes(key));
    this.count.textContent = this.list.length === 1 ? '1 name' : `${this.list.length} names`;
    this.table.cells.clear();
    this.table.rows.replaceChildren(...this.list.map(one => {
      const row = make('tr'), name = make('th'), value = make('td', 'value');
      name.scope = 'row';
      const link = make('a', '', one.name);
      link.href = '#n' + one.id;
      link.onclick = event => { event.preventDefault(); this.choose({dataset: {id: one.id, name: one.name}}); };
      name.append(link);
      const writes = make('td'), reads = make('td');
      writes.append(one.writes.length ? rungLinks(one.writes, this.go, 6) : make('span', 'soft', one.kind === 'i' ? 'machine' : 'no rung'));
      reads.append(one.reads.length ? rungLinks(one.reads, this.go, 6) : make('span', 'soft', one.kind === 'o' ? 'machine' : 'no rung'));
      row.append(make('td', 'soft', one.kind === 'i' ? 'in' : 'out'), make('td', 'addr', one.address), name, value,
        make('td', '', one.comment), writes, reads);
      this.table.cells.set(one.name, [value, one.id]);
      return row;
    }));
    this.onchange?.();
  }

  follows() {
    if (!this.list) return [];
    const first = Math.max(0, Math.floor(this.box.scrollTop / kIoRow) - 4);
    return this.list.slice(first, first + Math.ceil(this.box.clientHeight / kIoRow) + 8).map(one => one.name);
  }
  draw(picture) { this.table.draw(picture); }
}

// What happened: messages that came and went, faults, what people did.
export class History {
  constructor(box, seek) {
    Object.assign(this, {box, seek, last: 0, list: []});
    this.table = make('table');
    this.table.innerHTML = '<thead><tr><th scope="col">Scan</th><th scope="col">Time</th><th scope="col">What</th><th scope="col"></th></tr></thead>';
    this.rows = make('tbody');
    this.table.append(this.rows);
    this.empty = make('p', 'soft', 'Nothing has happened yet: messages, faults and what is written appear here.');
    box.append(this.empty, this.table);
  }

  async update(newest) {
    if (newest <= this.last || this.busy) return;
    this.busy = true;
    try {
      for (const [number, scan, us, kind, text] of await get('events?after=' + this.last)) {
        this.last = number;
        this.list.push({scan, us, kind, text});
        const row = make('tr', 'k-' + kind), cell = make('td', 'num'), link = make('a', '', scan);
        link.href = '#scan';
        link.title = 'Go back to this scan';
        link.onclick = event => { event.preventDefault(); this.seek(scan); };
        cell.append(link);
        row.append(cell, make('td', 'num', timeText(us)), make('td', 'kind', kindText(kind)), make('td', '', text));
        this.rows.prepend(row);
      }
      while (this.rows.children.length > 1000) this.rows.lastChild.remove();
      this.empty.hidden = this.list.length > 0;
      this.onchange?.();
    } catch { /* with the next picture */ }
    this.busy = false;
  }
}

export function kindText(kind) {
  return {gone: 'message gone', statement: 'operator', begin: 'beginning', lost: 'missing'}[kind] ?? kind;
}

export function timeText(us) {
  const s = us / 1e6, h = Math.floor(s / 3600), m = Math.floor(s / 60) % 60;
  const rest = (s % 60).toFixed(3);
  return h ? `${h}:${String(m).padStart(2, '0')}:${rest.padStart(6, '0')}` : m ? `${m}:${rest.padStart(6, '0')}` : `${rest} s`;
}
