// The pane of rungs: rows at known heights, of which only those near the visible part exist.
import {make} from './elements.js';
import {get} from './link.js';

const kBeyond = 600;  // pixels drawn above and below the visible part
const kCached = 600;  // rows whose HTML is kept
const kChunk = 40;
const kKinds = {f: 'file', m: 'module', s: 'section', c: 'comment', r: 'rung', d: 'chart'};

// Drawings are cut for tablets (1) and telephones (2), as app.css has it.
export const widthOfPage = () => innerWidth <= 760 ? 2 : innerWidth <= 1000 ? 1 : 0;

export class Pane {
  constructor(pane, space, index, width, chosen) {
    this.pane = pane;
    this.space = space;
    this.index = index;
    this.width = width;
    this.chosen = chosen;  // called with the element that was clicked
    this.measure();
    this.rungRow = new Map();
    index.numbers.forEach((number, row) => { if (number) this.rungRow.set(number, row); });
    this.cache = new Map();   // row: [html, name]
    this.asked = new Set();   // chunks on their way
    this.shown = new Map();   // row: its element
    this.flows = {};
    this.texts = {};
    this.forcedIds = new Set();
    this.causes = new Map();
    this.shares = new Map();
    this.focusRow = -1;
    this.onrange = () => {};
    pane.addEventListener('scroll', () => this.soon(), {passive: true});
    new ResizeObserver(() => this.resized()).observe(pane);
    space.addEventListener('click', event => this.click(event));
    this.soon();
  }

  // Where the rows are.
  measure() {
    this.tops = [0];
    for (const height of this.index.heights) this.tops.push(this.tops[this.tops.length - 1] + height);
    this.space.style.height = this.tops[this.tops.length - 1] + 200 + 'px';
  }

  // A pane that becomes narrow, or wide again, has other drawings.
  async resized() {
    const width = widthOfPage();
    if (!this.pane.clientWidth || width === this.width) return this.soon();
    this.width = width;
    const at = this.focusRow >= 0 ? this.focusRow : this.visible()[0];
    this.index.heights = (await get('index?width=' + width)).heights;
    this.cache.clear();
    for (const element of this.shown.values()) element.remove();
    this.shown.clear();
    this.measure();
    this.pane.scrollTop = this.tops[at];
    this.soon();
  }

  soon() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => { this.waiting = false; this.show(); });
  }

  rowAt(y) {
    let low = 0, high = this.index.heights.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.tops[middle + 1] <= y) low = middle + 1; else high = middle;
    }
    return Math.min(low, this.index.heights.length - 1);
  }

  visible() {
    const top = this.pane.scrollTop, bottom = top + this.pane.clientHeight;
    return [this.rowAt(top), this.rowAt(bottom) + 1];
  }

  show() {
    if (!this.index.heights.length || !this.pane.clientHeight) return;
    const first = this.rowAt(Math.max(0, this.pane.scrollTop - kBeyond));
    const end = this.rowAt(this.pane.scrollTop + this.pane.clientHeight + kBeyond) + 1;
    for (const [row, element] of this.shown)
      if (row < first || row >= end) { element.remove(); this.shown.delete(row); }
    for (let row = first; row < end; ++row) {
      if (this.cache.has(row)) this.put(row); else this.ask(row);
    }
    this.range = [first, end];
    this.onrange(this.range);
  }

  async ask(row) {
    const chunk = Math.floor(row / kChunk), width = this.width;
    if (this.asked.has(chunk)) return;
    this.asked.add(chunk);
    try {
      const range = `from=${chunk * kChunk}&to=${(chunk + 1) * kChunk}&width=${width}`;
      for (const [number, html, name] of await get('rungs?' + range))
        if (width === this.width) this.cache.set(number, [html, name]);
      while (this.cache.size > kCached) {
        const oldest = [...this.cache.keys()].find(one => !this.shown.has(one));
        if (oldest === undefined) break;
        this.cache.delete(oldest);
      }
    } catch { /* it is asked for again */ }
    this.asked.delete(chunk);
    this.soon();
  }

  put(row) {
    if (this.shown.has(row)) return;
    const kind = this.index.kinds[row];
    const element = make(kind === 'r' ? 'article' : 'div', 'row is-' + kKinds[kind]);
    const [html, name] = this.cache.get(row);
    element.style.top = this.tops[row] + 'px';
    element.style.height = this.index.heights[row] + 'px';
    element.dataset.row = row;
    element.innerHTML = html;
    if (kind === 'r') {
      element.id = 'r' + this.index.numbers[row];
      element.dataset.rung = this.index.numbers[row];
      element.tabIndex = row === this.focusRow ? 0 : -1;
      element.setAttribute('role', 'listitem');
      element.setAttribute('aria-label', name);
      element.rungName = name;
    }
    if (kind === 'r' || kind === 'd') {
      element.cells = new Map();
      for (const one of element.querySelectorAll('[data-n],[data-c]')) {
        const cell = Number(one.dataset.n ?? one.dataset.c);
        if (!element.cells.has(cell)) element.cells.set(cell, []);
        element.cells.get(cell).push(one);
      }
    }
    this.space.append(element);
    this.shown.set(row, element);
    if (row === this.focusRow) element.classList.add('now');
    this.paint(row);
    this.markForced(element);
    this.markCauses(row, element);
    this.markShare(element);
  }

  // By rung: the colour, from 1, and a text.
  setShares(shares) {
    this.shares = shares;
    for (const element of this.shown.values()) this.markShare(element);
  }

  markShare(element) {
    const share = this.shares.get(Number(element.dataset.rung));
    element.querySelector('.share')?.remove();
    delete element.dataset.heat;
    if (!share) return;
    element.dataset.heat = share.step;
    element.querySelector('.cap').append(make('em', 'share', share.text));
  }

  // What decided, by row, as *why* has found it.
  setCauses(causes) {
    this.causes = causes;
    for (const [row, element] of this.shown) this.markCauses(row, element);
  }

  markCauses(row, element) {
    const causes = this.causes.get(row);
    element.classList.toggle('reason', causes !== undefined);
    const ids = new Set(causes?.flatMap(([, , ids]) => ids).map(String)), names = new Set(causes?.map(([name]) => name));
    for (const one of element.querySelectorAll('.k'))
      one.classList.toggle('cause', names.has(one.dataset.name) || ids.has(one.dataset.id));
    for (const one of element.querySelectorAll('.x ~ g a')) // operands of boxes are names alone
      one.classList.toggle('cause', ids.has(one.getAttribute('href').slice(2)));
  }

  // The power in a rung. Every element says in data-on whether it is on; wires, whether they have power.
  paint(row) {
    const element = this.shown.get(row);
    if (!element || !element.cells) return;
    const flow = this.flows[row];
    if (flow !== undefined && element.dataset.flow !== flow) {
      element.dataset.flow = flow;
      element.classList.toggle('idle', flow === '');
      for (const [cell, parts] of element.cells) {
        const state = flow ? flow.charCodeAt(cell) - 48 : -3;
        for (const part of parts) {
          const on = state < 0 ? '' : (part.dataset.n !== undefined ? state & 2 : state & 1) ? '1' : '0';
          if (part.dataset.on !== on) part.dataset.on = on;
        }
      }
      if (document.activeElement === element) this.describe(element);
    }
    for (const text of element.querySelectorAll('.v')) {
      const value = this.texts[row + '.' + text.dataset.v];
      const shown = value === undefined ? '' : value;
      if (text.textContent !== shown) text.textContent = shown;
    }
  }

  // All rows of a picture at once: what is drawn is always of one scan.
  draw(picture) {
    this.flows = picture.rows;
    this.texts = picture.texts;
    const forced = new Set(picture.forces.flatMap(cell => cell.ids));
    const same = forced.size === this.forcedIds.size && [...forced].every(id => this.forcedIds.has(id));
    this.forcedIds = forced;
    for (const [row, element] of this.shown) {
      this.paint(row);
      if (!same) this.markForced(element);
    }
    this.space.dataset.scan = picture.scan;
  }

  markForced(element) {
    for (const one of element.querySelectorAll('.forced')) one.classList.remove('forced');
    for (const mark of element.querySelectorAll('.mark-forced')) mark.remove();
    if (!this.forcedIds.size) return;
    for (const one of element.querySelectorAll('[data-id]')) {
      if (!this.forcedIds.has(Number(one.dataset.id))) continue;
      one.classList.add('forced');
      const box = one.querySelector('rect');
      if (!box) continue;
      const mark = document.createElementNS('http://www.w3.org/2000/svg', 'text');
      mark.setAttribute('class', 'mark-forced');
      mark.setAttribute('x', Number(box.getAttribute('x')) + Number(box.getAttribute('width')) + 3);
      mark.setAttribute('y', Number(box.getAttribute('y')) + 4);
      mark.textContent = 'F';
      one.append(mark);
    }
  }

  // The rung in words, for those who hear it.
  describe(element) {
    const words = [];
    for (const one of element.querySelectorAll('.st[data-on="1"]')) words.push(`continues at step ${one.dataset.step}`);
    for (const one of element.querySelectorAll('[data-name]')) {
      const on = one.dataset.on, coil = one.classList.contains('o'), box = one.classList.contains('x');
      const state = on === '' || on === undefined ? 'not evaluated' :
        coil ? (on === '1' ? 'on' : 'off') : box ? (on === '1' ? 'has power' : 'no power') :
        on === '1' ? 'conducts' : 'does not conduct';
      words.push(`${one.dataset.name || one.dataset.mark} ${state}${one.classList.contains('forced') ? ', forced' : ''}`);
    }
    const share = this.shares.get(Number(element.dataset.rung));
    if (share) words.push(share.text);
    element.setAttribute('aria-label', `${element.rungName}. ${words.join('; ')}`);
  }

  // `place`: the element of the name with this id is marked, and scrolled to; {id, writes: a coil rather than a contact}.
  go(row, {focus = true, place} = {}) {
    if (row === undefined) return;
    const top = this.tops[row], height = this.index.heights[row];
    const inside = top >= this.pane.scrollTop && top + height <= this.pane.scrollTop + this.pane.clientHeight;
    if (!inside) this.pane.scrollTop = Math.max(0, top - Math.max(12, (this.pane.clientHeight - height) / 3));
    this.shown.get(this.focusRow)?.classList.remove('now');
    this.focusRow = row;
    this.show();
    const there = () => {
      const element = this.shown.get(row);
      if (!element) return void setTimeout(there, 40);
      element.classList.add('now');
      element.tabIndex = 0;
      if (focus) { element.focus({preventScroll: true}); this.describe(element); }
      if (place) this.goElement(element, place);
    };
    there();
  }

  goRung(number, place) { this.go(this.rungRow.get(number), {place}); }

  // Once what opens beside the rungs has taken its room.
  goElement(element, {id, writes}) {
    const all = [...element.querySelectorAll(`.k[data-id="${id}"]`)];
    const one = all.find(each => each.classList.contains('o') === writes) ?? all[0] ?? element.querySelector(`svg a[href="#n${id}"]`);
    this.mark(one);
    requestAnimationFrame(() => one?.scrollIntoView({block: 'nearest', inline: 'nearest'}));
  }

  focus() { this.shown.get(this.focusRow)?.focus({preventScroll: true}); }

  // The next or previous rung from the focused one.
  move(step) {
    let row = this.focusRow < 0 ? this.visible()[0] - step : this.focusRow;
    do row += step; while (row >= 0 && row < this.index.kinds.length && this.index.kinds[row] !== 'r');
    if (row >= 0 && row < this.index.kinds.length) this.go(row);
  }

  // The next or previous element of the focused rung.
  moveElement(step) {
    const element = this.shown.get(this.focusRow);
    if (!element) return;
    const all = [...element.querySelectorAll('[data-name]')].sort((a, b) => a.dataset.c - b.dataset.c);
    const at = all.findIndex(one => one.classList.contains('at'));
    const next = all[(at < 0 && step < 0 ? all.length - 1 : at + step + all.length) % all.length];
    this.select(next);
    next?.scrollIntoView({block: 'nearest', inline: 'nearest'});
  }

  mark(one) {
    for (const old of this.space.querySelectorAll('.at')) old.classList.remove('at');
    one?.classList.add('at');
  }

  select(one) {
    this.mark(one);
    if (one) this.chosen(one);
  }

  click(event) {
    const link = event.target.closest('a');
    const article = event.target.closest('article');
    if (link) {
      event.preventDefault();
      const [kind, id] = [link.getAttribute('href')[1], Number(link.getAttribute('href').slice(2))];
      if (kind === 'r') this.goRung(id); else this.chosen({dataset: {id, name: link.textContent}});
      return;
    }
    if (!article) return;
    const row = Number(article.dataset.row);
    if (row !== this.focusRow) {
      this.shown.get(this.focusRow)?.classList.remove('now');
      this.focusRow = row;
      article.classList.add('now');
      article.tabIndex = 0;
    }
    const one = event.target.closest('[data-name]');
    if (one) this.select(one);
  }
}
