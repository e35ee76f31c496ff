// What share of the work each rung is, as colours beside the rungs.
import {get} from './link.js';
import {button, make} from './elements.js';
import {rungLinks} from './panels.js';

const kScans = 200;
const kListed = 8;

const percent = share => `${(share * 100).toFixed(share < 0.0995 ? 1 : 0)} %`;

export class Profile {
  constructor(legend, toggle, pane, go, tell) {
    Object.assign(this, {legend, toggle, pane, go, tell, on: false});
    toggle.onclick = () => this.show(!this.on);
  }

  // It belongs to the view of the rungs.
  place(visible) {
    this.toggle.hidden = !visible;
    this.legend.hidden = !visible || !this.on;
  }

  async show(on) {
    this.on = on;
    this.toggle.setAttribute('aria-pressed', String(on));
    this.legend.hidden = !on;
    if (!on) return this.pane.setShares(new Map());
    this.legend.replaceChildren(make('span', 'soft', `Counting the last ${kScans} scans …`));
    try {
      const shares = await get('shares?scans=' + kScans);
      if (!this.on) return;
      const scans = shares.last - shares.first + 1;
      this.pane.setShares(new Map(shares.rungs.map(([rung, runs, share, step]) =>
        [rung, {step, text: runs ? `${percent(share)}, ${runs === scans ? 'once a scan' : `${runs} runs in ${scans} scans`}` : `never in ${scans} scans`}])));
      this.fill(shares);
    } catch (error) {
      this.tell(error.message, true);
      this.show(false);
    }
  }

  fill({first, last, steps, most, rungs}) {
    const scale = make('span', 'scale');
    for (let step = 1; step <= steps; ++step) {
      const one = make('span', 'heat', `${percent(most * (step - 1) / steps)} – ${percent(most * step / steps)}`);
      one.dataset.heat = step;
      scale.append(one);
    }
    const top = rungs.filter(rung => rung[2] > 0).sort((a, b) => b[2] - a[2]).slice(0, kListed).map(rung => rung[0]);
    const hottest = make('span', '', 'Most: ');
    hottest.append(rungLinks(top, this.go));
    this.legend.replaceChildren(make('b', '', 'Share of all operations'), make('span', 'soft', `scans ${first} to ${last}`),
      scale, hottest, button('Again', () => this.show(true), `Count the last ${kScans} scans again`));
  }
}
