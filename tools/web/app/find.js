// The search: names, addresses and terminals, rungs by number, texts.
import {make} from './elements.js';
import {get} from './link.js';

// An address with and without leading zeros, X002.1 and X2.1, is the same.
const plain = text => text.toLowerCase().replace(/\b([a-z])0+(?=\d)/g, '$1');

// What was written exactly comes first: the name (0), the address (1); then what begins so (2), and what has it (3).
function rankOf(one, key) {
  const name = plain(one.name), address = plain(one.address);
  if (name === key) return 0;
  if (address === key) return 1;
  return name.startsWith(key) || address.startsWith(key) ? 2 : 3;
}

// The program's names, loaded once.
export class Names {
  async load() {
    if (this.loading) return this.loading;
    this.loading = get('names').then(all => {
      this.titles = all.titles;
      this.all = all.names.map(([id, name, address, comment, kind, uses, shapes]) => ({id, name, address, comment, kind, shapes,
        reads: uses.filter(rung => rung > 0), writes: uses.filter(rung => rung < 0).map(rung => -rung),
        key: plain(`${name} ${address} ${comment}`)}));
      this.byId = new Map(this.all.map(one => [one.id, one]));
      this.byName = new Map(this.all.map(one => [one.name, one]));
      this.plainTitles = this.titles.map(plain);
    });
    return this.loading;
  }
}

export class Find {
  constructor(input, list, names, index, choose) {
    Object.assign(this, {input, list, names, index, choose, at: -1, results: []});
    input.oninput = () => this.search();
    input.onfocus = () => { names.load(); if (input.value) this.search(); };
    input.onblur = () => setTimeout(() => this.close(), 150);
    input.onkeydown = event => this.key(event);
    input.form.onsubmit = event => event.preventDefault();
  }

  async search() {
    const what = this.input.value.trim();
    await this.names.load();
    if (what !== this.input.value.trim() || what === this.searched) return;
    this.searched = what;
    const key = plain(what), results = [];
    if (/^\d+$/.test(what) && this.index.numbers.includes(Number(what)))
      results.push({kind: 'Rung', text: 'Rung ' + what, rung: Number(what)});
    if (key) {
      const ranks = [[], [], [], []];
      for (const one of this.names.all) {
        if (!one.key.includes(key)) continue;
        ranks[rankOf(one, key)].push({kind: {i: 'Input', o: 'Output', c: 'Constant', t: 'Text'}[one.kind] ?? 'Name', text: one.name,
          more: [one.address, one.comment].filter(Boolean).join(' · '), name: one});
      }
      const [names, addresses, starts, others] = ranks;
      results.unshift(...names);
      results.push(...addresses, ...starts.slice(0, 30), ...others.slice(0, 20));
      for (let row = 0; row < this.names.plainTitles.length && results.length < 60; ++row)
        if (this.names.plainTitles[row].includes(key))
          results.push({kind: this.index.numbers[row] ? 'Rung ' + this.index.numbers[row] : 'Heading',
            text: this.names.titles[row].split('\n')[0].slice(0, 90), row});
    }
    this.results = results;
    this.at = results.length ? 0 : -1;
    this.fill(what);
  }

  fill(what) {
    this.list.replaceChildren(...this.results.map((one, i) => {
      const item = make('li');
      item.setAttribute('role', 'option');
      item.id = 'found-' + i;
      item.append(make('span', 'kind', one.kind), make('span', 'name', one.text), make('span', 'about', one.more ?? ''));
      item.onmousedown = event => { event.preventDefault(); this.take(i); };
      return item;
    }));
    if (what && !this.results.length) this.list.append(make('li', 'none', 'Nothing found'));
    this.list.hidden = !what;
    this.input.setAttribute('aria-expanded', String(Boolean(what)));
    this.mark();
  }

  mark() {
    [...this.list.children].forEach((item, i) => item.setAttribute('aria-selected', String(i === this.at)));
    this.input.setAttribute('aria-activedescendant', this.at < 0 ? '' : 'found-' + this.at);
    this.list.children[this.at]?.scrollIntoView({block: 'nearest'});
  }

  key(event) {
    const step = {ArrowDown: 1, ArrowUp: -1}[event.key];
    if (step && this.results.length) {
      this.at = (this.at + step + this.results.length) % this.results.length;
      this.mark();
    } else if (event.key === 'Enter') {
      this.search().then(() => { if (this.at >= 0) this.take(this.at); });
    } else if (event.key === 'Escape') {
      this.input.value = '';
      this.close();
      this.input.blur();
    } else {
      return;
    }
    event.preventDefault();
  }

  take(i) {
    this.close();
    this.input.blur();
    this.choose(this.results[i]);
  }

  close() {
    this.searched = null;
    this.list.hidden = true;
    this.input.setAttribute('aria-expanded', 'false');
  }
}
