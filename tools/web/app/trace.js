// The watched names over the last scans, each as a line; a click goes to its scan.
import {get} from './link.js';
import {make} from './panels.js';

const kScans = 400, kHeight = 34;

export class Trace {
  constructor(box, watch, seek, tell) {
    Object.assign(this, {box, watch, seek, tell});
    const bar = make('div', 'add'), button = make('button', '', `Trace the last ${kScans} scans`);
    button.id = 'trace';
    button.onclick = () => this.load();
    bar.append(button);
    this.lines = make('div', 'lines');
    box.append(bar, this.lines);
  }

  async load() {
    const names = this.watch.follows().slice(0, 16);
    if (!names.length) return this.tell('Watch a name first', true);
    try {
      const trace = await get('trace?' + new URLSearchParams({names: names.join('\n'), scans: kScans}));
      this.lines.replaceChildren(...names.map((name, i) => this.line(name, trace.values[i], trace.first)));
    } catch (error) { this.tell(error.message, true); }
  }

  line(name, texts, first) {
    const row = make('div', 'line'), svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    const values = texts.map(text => Number.parseFloat(text) || 0);
    const least = Math.min(...values), most = Math.max(...values), span = most - least || 1;
    const y = value => kHeight - 4 - (value - least) / span * (kHeight - 8);
    let path = `M0 ${y(values[0])}`;
    values.forEach((value, i) => { if (i && value !== values[i - 1]) path += `H${i}V${y(value)}`; });
    svg.setAttribute('viewBox', `0 0 ${values.length} ${kHeight}`);
    svg.setAttribute('preserveAspectRatio', 'none');
    svg.setAttribute('role', 'img');
    svg.setAttribute('aria-label', `${name} from scan ${first} to ${first + texts.length - 1}: ${texts[0]} to ${texts[texts.length - 1]}`);
    svg.innerHTML = `<path class="wave" d="${path}H${values.length}"/>`;
    svg.onclick = event => {
      const box = svg.getBoundingClientRect();
      this.seek(first + Math.min(values.length - 1, Math.floor((event.clientX - box.left) / box.width * values.length)));
    };
    // The trigger: to the scan in which it changed last.
    const change = values.findLastIndex((value, i) => i && value !== values[i - 1]);
    const last = make('button', '', change > 0 ? `changed in ${first + change}` : 'unchanged');
    last.disabled = change <= 0;
    last.onclick = () => this.seek(first + change);
    row.append(make('b', 'addr', name), svg, make('span', 'soft', least === most ? texts[0] : `${least} to ${most}`), last);
    return row;
  }
}
