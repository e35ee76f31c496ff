// The page: puts its parts together, and draws every picture in all of them at once.
import {make} from './elements.js';
import {get, post, Pictures} from './link.js';
import {Pane, widthOfPage} from './pane.js';
import {Tree} from './tree.js';
import {Find, Names} from './find.js';
import {Trace} from './trace.js';
import {Profile} from './profile.js';
import {History, timeText} from './history.js';
import {Detail, Terminals, Watch, Writer} from './panels.js';

const by = id => document.getElementById(id);
const kStates = {running: 'Running', paused: 'Paused', past: 'Past', fault: 'Fault', stopped: 'Stopped', lost: 'No connection'};

let picture = null;       // the one that is drawn
let seeking = null;       // the scan that was last asked for, while an answer is awaited
let unreached = null;     // the scan that was asked for while there was no connection
let dragging = false;     // the time line is held
let tab = 'ladder';

function tell(text, wrong = false) {
  const toast = by('toast');
  toast.textContent = text;
  toast.classList.toggle('wrong', wrong);
  toast.hidden = false;
  clearTimeout(tell.timer);
  tell.timer = setTimeout(() => { toast.hidden = true; }, wrong ? 8000 : 3500);
}

// Null: it was refused, or there is no connection, which fetch reports by a TypeError.
async function order(what, unanswered) {
  try {
    return await post('order', what);
  } catch (error) {
    if (error instanceof TypeError) unanswered?.(); else tell(error.message, true);
    return null;
  }
}

// One request at a time: what is asked for meanwhile comes afterwards, once. Without a connection it waits for that.
async function seek(scan) {
  if (seeking !== null) { seeking = scan; return; }
  seeking = scan;
  for (;;) {
    const asked = seeking;
    await order({do: 'seek', scans: asked}, () => { unreached = seeking; });
    if (seeking === asked) break;
  }
  seeking = null;
}

const step = scans => order({do: 'step', scans});
const follows = () => picture && picture.follows;
const go = () => order({do: follows() ? 'pause' : 'run'});

function setTheme(next) {
  if (next) document.documentElement.dataset.theme = next; else delete document.documentElement.dataset.theme;
  try { localStorage.setItem('rung-theme', next); } catch { /* it lasts as long as the page */ }
}
try { setTheme(localStorage.getItem('rung-theme') ?? ''); } catch { /* the system's */ }

function isDark() {
  const set = document.documentElement.dataset.theme;
  return set ? set === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
}

// `buttons`: [text, what it does], the first one also by Enter; one that returns a text keeps the dialog open, which
// says it.
function dialog(title, parts, buttons) {
  const box = by('dialog'), form = make('form'), row = make('div', 'actions'), wrong = make('p', 'wrong');
  wrong.setAttribute('role', 'alert');
  const press = act => {
    const refused = act?.();
    if (typeof refused !== 'string') return box.close();
    wrong.textContent = refused;
    form.querySelector('input')?.focus();
  };
  buttons.forEach(([text, act], i) => {
    const one = make('button', '', text);
    one.type = i ? 'button' : 'submit';
    if (i) one.onclick = () => press(act);
    row.append(one);
  });
  form.onsubmit = event => { event.preventDefault(); press(buttons[0][1]); };
  const head = make('h2', '', title);
  head.id = 'dialog-title';
  form.append(head, ...parts, wrong, row);
  box.replaceChildren(form);
  box.showModal();
}

function keysDialog() {
  const list = make('dl', 'keys');
  for (const [key, what] of [['/', 'search'], ['Space', 'run or pause'], [', and .', 'one scan back or on'],
    ['↑ ↓', 'rung before, rung after'], ['← →', 'elements of the rung'], ['Home End', 'first, last rung'],
    ['w', 'watch the selected name'], ['p', 'profile of the rungs'], ['1 2 3 4', 'views'], ['Esc', 'close']])
    list.append(make('dt', '', key), make('dd', '', what));
  dialog('Keys', [list], [['Close']]);
}

// What is said before another program is drawn is said again by the page with that one.
const kSaid = 'rung-said';
function reload() {
  try { sessionStorage.setItem(kSaid, 'Another program runs now: it is shown from here on, and writing is off'); } catch { /* it is seen all the same */ }
  location.reload();
}
function sayWhatWasSaid() {
  try {
    const said = sessionStorage.getItem(kSaid);
    if (said) tell(said);
    sessionStorage.removeItem(kSaid);
  } catch { /* nothing was kept */ }
}

async function start() {
  const width = widthOfPage();
  const index = await get('index?width=' + width);
  document.title = index.title + ' – Rung';
  by('title').textContent = index.title;
  by('control').textContent = index.control;

  const names = new Names();
  const writer = new Writer(tell);
  const showTab = which => {
    tab = which;
    for (const one of ['ladder', 'watch', 'io', 'log']) {
      by(one).hidden = one !== which;
      by('tab-' + one).setAttribute('aria-selected', String(one === which));
      by('tab-' + one).tabIndex = one === which ? 0 : -1;
    }
    if (which === 'io') terminals.fill();
    if (which === 'ladder') pane.soon();
    profile.place(which === 'ladder');
    follow();
  };
  const goRung = (number, place) => { closeSide(); showTab('ladder'); pane.goRung(number, place); };
  const goRow = row => { closeSide(); showTab('ladder'); pane.go(row, {focus: index.kinds[row] === 'r'}); };
  const choose = element => { detail.show(element).then(follow); };

  const pane = new Pane(by('ladder'), by('space'), index, width, choose);
  const tree = new Tree(by('tree'), index, goRow);
  const watch = new Watch(by('watch'), names, writer, choose, 'rung-watch-' + index.title);
  const detail = new Detail(by('detail'), names, writer, {go: goRung, goRow, seek, causes: map => pane.setCauses(map), back: () => pane.focus(),
    watch: name => { watch.add(name); tell(`${name} is watched`); }});
  const terminals = new Terminals(by('io'), names, goRung, choose);
  const history = new History(by('log'), writer, seek);
  new Find(by('what'), by('found'), names, index, found => {
    if (found.name) {
      choose({dataset: {id: found.name.id, name: found.name.name}});
      const first = found.name.writes[0] ?? found.name.reads[0];
      if (first && tab === 'ladder') goRung(first, {id: found.name.id, writes: found.name.writes.length > 0});
    } else if (found.rung) {
      goRung(found.rung);
    } else {
      goRow(found.row);
    }
  });
  watch.fill();
  sayWhatWasSaid();
  const trace = new Trace(by('watch'), watch, seek, tell);
  history.onnews = news => trace.news(news);
  const profile = new Profile(by('legend'), by('profile'), pane, goRung, tell);

  // What the next pictures must have.
  function follow() {
    const wanted = new Set(detail.name ? [detail.name] : []);
    for (const name of tab === 'watch' ? watch.follows() : tab === 'io' ? terminals.follows() : []) wanted.add(name);
    pictures.follow(tab === 'ladder' && pane.range ? pane.range : [0, 0], [...wanted]);
  }
  watch.onchange = terminals.onchange = () => follow();
  pane.onrange = () => {
    by('here').textContent = tree.here(pane.visible()[0]);
    follow();
  };

  function draw(next) {
    if (next.program !== index.program) return reload(); // another program is shown from now on
    picture = next;
    if (next.mayWrite && writer.on) { turnWriting(false); tell(next.mayWrite, true); }
    by('state').textContent = kStates[next.state];
    by('status').dataset.state = next.state;
    by('pill').title = next.fault;
    by('notice').hidden = !next.notice;
    if (by('notice').textContent !== next.notice) by('notice').textContent = next.notice;
    const stopped = next.ran ? `The operator has stopped the program. Rungs are as in scan ${next.ran}, the last one that ran; ` +
      `values are those of scan ${next.scan}.` : '';
    by('stopped').hidden = !stopped;
    if (by('stopped').textContent !== stopped) by('stopped').textContent = stopped;
    by('scan').textContent = next.scan;
    by('time').textContent = timeText(next.us);
    by('go').textContent = next.follows ? 'Pause' : !index.live ? 'Play' : index.machine || next.scan < next.last ? 'To now' : 'Run';
    by('back').disabled = next.scan <= next.first;
    const slider = by('slider');
    slider.min = next.first;
    slider.max = next.last;
    if (seeking === null && !dragging) slider.value = next.scan;
    slider.setAttribute('aria-valuetext', `scan ${next.scan}, ${timeText(next.us)}`);
    by('forced').hidden = !next.forces.length;
    by('forced').textContent = `${next.forces.length} forced`;
    by('forced').title = next.forces.map(cell => `${cell.name} = ${cell.value}`).join('\n');
    const newest = next.fault || next.messages.map(([number, text]) => `${number} ${text}`).join('   ·   ');
    if (by('messages').textContent !== (newest || 'No messages')) by('messages').textContent = newest || 'No messages';
    by('messages').classList.toggle('any', Boolean(newest));
    by('messages').title = next.messages.map(([number, text]) => `${number} ${text}`).join('\n') || 'Messages that the operator sees';
    pane.draw(next);
    watch.draw(next);
    terminals.draw(next);
    detail.draw(next);
    trace.draw({...next, live: index.live});
    history.draw();
    history.update(next.event);
    drawMarks();
    document.body.dataset.scan = next.scan;
  }

  // Messages, faults and what people did, on the time line.
  let marked = '';
  function drawMarks() {
    const canvas = by('marks'), width = canvas.clientWidth;
    const key = [width, picture.first, picture.last, history.list.length, isDark()].join();
    if (key === marked || !width) return;
    marked = key;
    const ratio = devicePixelRatio || 1, style = getComputedStyle(document.documentElement);
    canvas.width = width * ratio;
    canvas.height = canvas.clientHeight * ratio;
    const pen = canvas.getContext('2d');
    pen.scale(ratio, ratio);
    for (const one of history.list) {
      if (one.scan < picture.first || picture.last <= picture.first) continue;
      const x = 8 + (one.scan - picture.first) / (picture.last - picture.first) * (width - 16);
      pen.fillStyle = style.getPropertyValue(one.kind === 'fault' ? '--warn' : one.kind === 'message' ? '--part' : one.kind === 'gone' ? '--soft' : '--link');
      pen.fillRect(x - 1, 0, 2, canvas.clientHeight);
    }
  }

  const pictures = new Pictures(draw, lost => {
    by('lost').hidden = !lost;
    document.body.classList.toggle('is-lost', lost);
    if (!lost && unreached !== null) {
      const scan = unreached;
      unreached = null;
      seek(scan);
    }
    if (lost) { by('status').dataset.state = 'lost'; by('state').textContent = kStates.lost; by('lost-scan').textContent = picture?.scan ?? '–'; }
  });

  // ---- what people do ----
  by('go').onclick = go;
  by('back').onclick = () => step(-1);
  by('step').onclick = () => step(1);
  by('slider').oninput = () => seek(Number(by('slider').value));
  by('slider').onpointerdown = () => { dragging = true; };
  by('slider').onpointerup = by('slider').onpointercancel = () => { dragging = false; };
  by('messages').onclick = () => showTab('log');
  by('forced').onclick = () => dialog('Forced', [list(picture.forces.map(cell => `${cell.name} = ${cell.value}`))],
    writer.on ? [['Release all', () => writer.send({do: 'unforce', name: ''})], ['Close']] : [['Close']]);
  for (const one of ['ladder', 'watch', 'io', 'log']) by('tab-' + one).onclick = () => showTab(one);
  by('tabs').onkeydown = event => {
    const all = ['ladder', 'watch', 'io', 'log'], delta = {ArrowRight: 1, ArrowLeft: -1}[event.key];
    if (!delta) return;
    const next = all[(all.indexOf(tab) + delta + all.length) % all.length];
    showTab(next);
    by('tab-' + next).focus();
    event.preventDefault();
    event.stopPropagation();
  };

  function turnWriting(on) {
    writer.on = on;
    by('writing').setAttribute('aria-pressed', String(on));
    by('writing').textContent = on ? 'Writing on' : 'Writing off';
    document.body.classList.toggle('is-writing', on);
    if (picture) draw(picture);
  }
  by('writing').onclick = () => {
    if (writer.on) return turnWriting(false);
    if (picture?.mayWrite) return tell(picture.mayWrite, true);
    dialog('Switch writing on?', [make('p', '', 'Then this page can set and force values of the running program. ' +
      'Each of them acts at once, is confirmed, and appears in the history.')],
    [['Switch on', () => turnWriting(true)], ['Cancel']]);
  };

  const closeSide = () => { document.body.classList.remove('side-open'); by('menu').setAttribute('aria-expanded', 'false'); };
  by('menu').onclick = () => {
    const open = document.body.classList.toggle('side-open');
    by('menu').setAttribute('aria-expanded', String(open));
    if (open) by('tree').querySelector('[tabindex="0"]')?.focus();
  };
  const items = () => [...by('menu-more').children].filter(item => !item.hidden);
  const more = open => {
    by('menu-more').hidden = !open;
    by('more').setAttribute('aria-expanded', String(open));
    if (open) items()[0].focus();
  };
  by('more').onclick = event => { event.stopPropagation(); more(by('menu-more').hidden); };
  document.addEventListener('click', () => more(false));
  by('menu-more').onkeydown = event => {
    const all = items(), at = all.indexOf(document.activeElement);
    const next = {ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: all.length - 1}[event.key];
    if (event.key === 'Escape') { more(false); by('more').focus(); }
    else if (event.key === 'Tab') more(false);
    else if (next !== undefined) all[(next + all.length) % all.length].focus();
    if (next !== undefined || event.key === 'Escape') event.preventDefault();
    event.stopPropagation();
  };
  by('theme').onclick = () => setTheme(isDark() ? 'light' : 'dark');
  by('keys').onclick = keysDialog;
  by('mark').hidden = by('reload').hidden = !index.machine;
  by('reload').onclick = () => {
    if (!writer.on) return tell('The machine would get another program: switch writing on first', true);
    dialog('Reload the program?', [make('p', '', 'The host compiles its sources as they are now, and the new program takes over ' +
      'between two scans.')], [['Reload', () => { tell('Compiling …'); writer.send({do: 'reload'}); }], ['Cancel']]);
  };
  by('mark').onclick = () => {
    if (!writer.on) return tell('A mark is written into the recording: switch writing on first', true);
    const text = make('input');
    text.setAttribute('aria-label', 'Text of the mark');
    text.maxLength = 400;
    dialog('Mark this moment', [make('p', '', 'The text appears on the time line, and the files of the recording are kept.'), text],
      [['Mark', () => {
        if (!text.value.trim()) return 'A mark needs a text.';
        writer.send({do: 'mark', name: text.value.trim()});
      }], ['Cancel']]);
  };
  by('other').onclick = async () => {
    try {
      const {link} = await post('link', {});
      const text = make('p', 'link', link);
      dialog('Link for another browser', [make('p', '', 'It opens this page once, in one browser.'), text],
        [['Copy', () => void navigator.clipboard?.writeText(link)], ['Close']]);
    } catch (error) { tell(error.message, true); }
  };

  document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || by('dialog').open) return;
    const typing = event.target.matches('input:not([type=range]), select, textarea');
    if (event.key === 'Escape') {
      if (typing && !event.target.closest('#detail')) return;
      const fromSide = by('side').contains(event.target);
      detail.close();
      closeSide();
      more(false);
      follow();
      if (fromSide) by('menu').focus();
      return;
    }
    if (typing) return;
    const inside = event.target.closest('article, #ladder, body') && !event.target.closest('#tree, #tabs, #io, #watch, #log');
    const acts = {
      '/': () => { by('what').focus(); by('what').select(); },
      ' ': () => event.target.matches('button') ? false : go(),
      ',': () => step(-1), '.': () => step(1), '?': keysDialog,
      w: () => { if (!detail.name) return false; watch.add(detail.name); tell(`${detail.name} is watched`); },
      p: () => { showTab('ladder'); by('profile').click(); },
      1: () => showTab('ladder'), 2: () => showTab('watch'), 3: () => showTab('io'), 4: () => showTab('log'),
    };
    if (inside && tab === 'ladder' && !event.target.matches('input'))
      Object.assign(acts, {ArrowDown: () => pane.move(1), ArrowUp: () => pane.move(-1),
        ArrowRight: () => pane.moveElement(1), ArrowLeft: () => pane.moveElement(-1),
        Home: () => pane.goRung(index.numbers.find(number => number)),
        End: () => pane.goRung(index.numbers.findLast(number => number)),
        Enter: () => event.target.matches('button, a') ? false : pane.moveElement(event.shiftKey ? -1 : 1)});
    const act = acts[event.key];
    if (act && act() !== false) event.preventDefault();
  });
}

function list(texts) {
  const box = make('ul', 'plain');
  for (const text of texts) box.append(make('li', '', text));
  return box;
}

start().catch(error => { by('state').textContent = 'Cannot be shown'; tell(error.message, true); });
