// Levels, modules and sections at the side, as a tree for the keyboard.
import {make} from './elements.js';

export class Tree {
  constructor(list, index, go) {
    this.list = list;
    this.items = [];
    for (const [level, row, text, title, first, last] of index.tree) {
      const item = make('li', 'level' + Math.min(level, 3));
      item.setAttribute('role', 'treeitem');
      item.setAttribute('aria-level', level + 1);
      item.tabIndex = -1;
      item.append(make('span', 'name', text), make('span', 'about', title));
      if (first) item.append(make('span', 'rungs', first === last ? first : `${first}–${last}`));
      item.onclick = () => { go(row); };
      item.row = row;
      this.items.push(item);
      list.append(item);
    }
    if (this.items.length) this.items[0].tabIndex = 0;
    list.addEventListener('keydown', event => this.key(event));
  }

  key(event) {
    const at = this.items.indexOf(document.activeElement);
    const step = {ArrowDown: 1, ArrowUp: -1, Home: -at, End: this.items.length - 1 - at}[event.key];
    if (event.key === 'Enter' || event.key === ' ') this.items[at]?.click();
    else if (step === undefined) return;
    else this.items[Math.min(this.items.length - 1, Math.max(0, at + step))].focus();
    event.preventDefault();
    event.stopPropagation();
  }

  // Marks where the pane is. Returns its text.
  here(row) {
    let now = null;
    for (const item of this.items) if (item.row <= row) now = item; else break;
    if (now === this.now) return now ? now.firstChild.textContent : '';
    this.now?.removeAttribute('aria-current');
    if (this.now) this.now.tabIndex = -1;
    this.now = now;
    if (!now) return '';
    now.setAttribute('aria-current', 'true');
    now.tabIndex = 0;
    if (now.offsetParent) now.scrollIntoView({block: 'nearest'});
    return now.firstChild.textContent;
  }
}
