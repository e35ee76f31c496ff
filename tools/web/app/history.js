// What has happened: the messages with their times, and everything in its order.
import {get} from './link.js';
import {button, link, make, tableOf} from './elements.js';

const kMost = 1000;  // entries that are kept, as the server does
const kKinds = {message: 'message', gone: 'message gone', acknowledged: 'acknowledged', fault: 'fault', trigger: 'trigger', set: 'set',
  force: 'force', statement: 'operator', mark: 'mark', begin: 'beginning', lost: 'missing'};

export function timeText(us) {
  const s = us / 1e6, h = Math.floor(s / 3600), m = Math.floor(s / 60) % 60;
  const rest = (s % 60).toFixed(3);
  return h ? `${h}:${String(m).padStart(2, '0')}:${rest.padStart(6, '0')}` : m ? `${m}:${rest.padStart(6, '0')}` : `${rest} s`;
}

export class History {
  // `onnews` is called with the entries that have come.
  constructor(box, writer, seek) {
    Object.assign(this, {box, writer, seek, last: 0, list: [], alarms: []});
    this.messages = tableOf([['text', 'Message'], ['', 'Came'], ['', 'Acknowledged'], ['', 'Gone']], 'Messages');
    this.messages.table.id = 'alarms';
    this.all = tableOf([['', 'Scan'], ['', 'Time'], ['', 'What'], ['', 'Text']], 'Everything');
    this.all.table.id = 'everything';
    this.empty = make('p', 'soft', 'Nothing has happened yet: messages, faults and what is written appear here.');
    this.acknowledge = button('Acknowledge all', () => writer.send({do: 'acknowledge'}), 'Note in the history that the messages have been seen');
    const bar = make('div', 'add');
    bar.append(this.acknowledge);
    box.append(this.empty, bar, this.messages.table, this.all.table);
    this.onnews = () => {};
    this.fill();
  }

  at(event, text = '') {
    return link(text + event.scan, '#scan' + event.scan, () => this.seek(event.scan), `Go back to scan ${event.scan}, ${timeText(event.us)}`);
  }

  async update(newest) {
    if (newest <= this.last || this.busy) return;
    this.busy = true;
    try {
      const news = [];
      for (const [number, scan, us, kind, text] of await get('events?after=' + this.last)) {
        this.last = number;
        news.push({number, scan, us, kind, text});
      }
      this.list.push(...news);
      this.list.splice(0, this.list.length - kMost);
      for (const event of news) this.add(event);
      this.fill();
      this.onnews(news);
    } catch { /* with the next picture */ }
    this.busy = false;
  }

  add(event) {
    if (event.kind === 'message') this.alarms.unshift({text: event.text, came: event});
    const alarm = this.alarms.find(one => one.text === event.text && !one.gone);
    if (alarm && event.kind === 'gone') alarm.gone = event;
    if (alarm && event.kind === 'acknowledged') alarm.acknowledged ??= event;
    this.alarms.splice(kMost);
    const row = make('tr', 'k-' + event.kind), scan = make('td', 'num');
    scan.append(this.at(event));
    row.append(scan, make('td', 'num', timeText(event.us)), make('td', 'kind', kKinds[event.kind] ?? event.kind), make('td', '', event.text));
    this.all.rows.prepend(row);
    while (this.all.rows.children.length > kMost) this.all.rows.lastChild.remove();
  }

  fill() {
    this.empty.hidden = this.list.length > 0;
    this.all.table.hidden = !this.list.length;
    this.messages.table.hidden = !this.alarms.length;
    this.messages.rows.replaceChildren(...this.alarms.map(alarm => {
      const row = make('tr', alarm.gone ? '' : 'on');
      row.append(make('td', 'text', alarm.text));
      for (const event of [alarm.came, alarm.acknowledged, alarm.gone]) {
        const cell = make('td', 'num');
        if (event) cell.append(make('span', '', timeText(event.us)), ' ', this.at(event, 'scan ')); else cell.append(make('span', 'soft', '–'));
        row.append(cell);
      }
      return row;
    }));
    this.draw();
  }

  draw() {
    this.acknowledge.parentElement.hidden = !this.writer.on || !this.alarms.some(one => !one.gone && !one.acknowledged);
  }
}
