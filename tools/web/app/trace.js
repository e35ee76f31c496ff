// The watched names over some scans, each as a line; a click goes to its scan. Either the last scans, or those around a
// scan in which a condition began to hold.
import {button, iconButton, link, make, select} from './elements.js';
import {get, post} from './link.js';

const kHeight = 34;

// The scans below the lines.
function axis(first, count) {
  const row = make('div', 'line axis'), scans = make('span', 'scans soft num');
  for (const scan of new Set([first, first + Math.floor(count / 2), first + count - 1])) scans.append(make('span', '', scan));
  row.append(make('span', 'soft', 'scan'), scans);
  return row;
}

export class Trace {
  constructor(box, watch, seek, tell) {
    Object.assign(this, {box, watch, seek, tell, hits: [], at: -1, condition: '', picture: null, loading: false});
    const bar = make('form', 'add');
    bar.id = 'trace-bar';
    this.scans = select('Scans of a trace', [100, 400, 2000].map(count => [count, `${count} scans`]), 400);
    this.when = make('input', 'when');
    this.when.placeholder = 'Condition, such as  rises X8.4 and D100 > 5';
    this.when.setAttribute('aria-label', 'Trigger: a condition, as of rungc replay --find');
    this.before = select('Scans before the trigger', [[0.1, '10 % before'], [0.5, '50 % before'], [0.9, '90 % before']], 0.5);
    this.mode = select('How often', [['once', 'once'], ['each', 'each time']], 'once');
    this.arm = make('button', '', 'Wait for it');
    this.arm.id = 'arm';
    bar.onsubmit = event => { event.preventDefault(); this.trigger(this.condition ? '' : this.when.value.trim()); };
    const last = button('Trace the last scans', () => { this.at = -1; this.load(0); });
    last.id = 'trace';
    bar.append(last, this.scans, make('span', 'soft', 'or around'), this.when, this.before, this.mode, this.arm);
    this.status = make('p', 'soft');
    this.status.id = 'hits';
    this.status.setAttribute('aria-live', 'polite');
    this.lines = make('div', 'lines');
    box.append(bar, this.status, this.lines);
  }

  // What is looked for is the program's: all pages have the same one.
  async trigger(condition) {
    try {
      if (condition) { this.hits = []; this.at = -1; this.once = this.mode.value === 'once'; }
      await post('order', {do: 'trigger', name: condition});
      this.tell(condition ? 'Waiting for: ' + condition : 'Not waiting any more');
    } catch (error) { this.tell(error.message, true); }
  }

  // Entries of the history that have come.
  news(events) {
    for (const event of events)
      if (event.kind === 'trigger' && !(this.once && this.hits.length && this.picture?.live)) this.hits.push(event.scan);
    this.tellHits();
  }

  tellHits() {
    const shown = this.at < 0 ? '' : `${this.at + 1} of ${this.hits.length}: scan `;
    this.status.replaceChildren(this.condition ? `Waiting for ${this.condition}. ` : '');
    if (!this.hits.length) return;
    if (this.at < 0) return this.status.append(`It began to hold ${this.hits.length === 1 ? 'once' : this.hits.length + ' times'}; the trace follows.`);
    this.status.append(shown, link(this.hits[this.at], '#scan' + this.hits[this.at], () => this.seek(this.hits[this.at]), 'Go to this scan'), ' ');
    for (const [text, step, label] of [['‹', -1, 'The time before'], ['›', 1, 'The next time']]) {
      const one = iconButton(text, () => { this.at += step; this.load(this.hits[this.at]); }, label);
      one.disabled = this.hits[this.at + step] === undefined;
      this.status.append(one);
    }
  }

  draw(picture) {
    const changed = this.condition !== picture.trigger;
    this.picture = picture;
    if (changed) {
      this.condition = picture.trigger;
      if (this.condition) this.when.value = this.condition;
      this.when.disabled = Boolean(this.condition);
      this.arm.textContent = this.condition ? 'Stop waiting' : 'Wait for it';
      this.tellHits();
    }
    // The newest one is shown once the scans after it have been; of a recording, the first.
    const next = this.at < 0 || !picture.live ? (this.at < 0 ? 0 : -1) : this.hits.length - 1;
    if (next < 0 || next === this.at || this.loading || this.hits[next] === undefined) return;
    if (picture.live && picture.last < this.hits[next] + this.after()) return;
    this.at = next;
    this.load(this.hits[next]);
    if (this.once && picture.live && this.condition) this.trigger('');
  }

  count() { return Number(this.scans.value); }
  after() { return Math.round(this.count() * (1 - Number(this.before.value))); }

  // `hit`: the scan of the trigger; 0: the last scans.
  async load(hit) {
    const names = this.watch.follows().slice(0, 16);
    if (!names.length) return this.tell('Watch a name first', true);
    this.loading = true;
    try {
      const trace = await get('trace?' + new URLSearchParams({names: names.join('\n'), scans: this.count(), last: hit ? hit + this.after() : 0}));
      const count = Math.max(...trace.values.map(values => values.length));
      this.lines.replaceChildren(...names.map((name, i) => this.line(name, trace.values[i], trace.first, count, hit)),
        axis(trace.first, count));
      this.tellHits();
    } catch (error) { this.tell(error.message, true); }
    this.loading = false;
  }

  // All lines have the width of `count` scans, so that what is above each other was at the same time.
  line(name, texts, first, count, hit) {
    const row = make('div', 'line'), svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    const values = texts.map(text => Number.parseFloat(text) || 0);
    const bits = values.every(value => value === 0 || value === 1);
    const least = Math.min(...values), most = Math.max(...values), span = bits ? 1 : most - least || 1;
    const y = value => kHeight - 4 - (value - (bits ? 0 : least)) / span * (kHeight - 8);
    let path = `M0 ${y(values[0])}`;
    values.forEach((value, i) => { if (i && value !== values[i - 1]) path += `H${i}V${y(value)}`; });
    svg.setAttribute('viewBox', `0 0 ${count} ${kHeight}`);
    svg.setAttribute('preserveAspectRatio', 'none');
    svg.setAttribute('role', 'img');
    svg.setAttribute('aria-label', `${name} from scan ${first} to ${first + texts.length - 1}: ${texts[0]} to ${texts[texts.length - 1]}`);
    svg.innerHTML = (hit ? `<path class="hit" d="M${hit - first} 0v${kHeight}"/>` : '') + `<path class="wave" d="${path}H${values.length}"/>`;
    svg.onclick = event => {
      const box = svg.getBoundingClientRect();
      this.seek(first + Math.min(values.length - 1, Math.floor((event.clientX - box.left) / box.width * count)));
    };
    // To the scan in which it changed last.
    const change = values.findLastIndex((value, i) => i && value !== values[i - 1]);
    const last = button(change > 0 ? `changed in ${first + change}` : 'unchanged', () => this.seek(first + change));
    last.disabled = change <= 0;
    row.append(make('b', 'addr', name), svg, make('span', 'soft', least === most ? texts[0] : `${least} to ${most}`), last);
    return row;
  }
}
