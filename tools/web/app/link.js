// Requests to the server, and the pictures that keep coming: the next is asked for when the last one has been drawn.

const page = Math.random().toString(36).slice(2) + Date.now().toString(36);

export async function get(path) {
  const answer = await fetch('/api/' + path);
  if (!answer.ok) throw new Error(await answer.text());
  return answer.json();
}

export async function post(path, body) {
  const answer = await fetch('/api/' + path, {
    method: 'POST', headers: {'Content-Type': 'application/json'}, body: JSON.stringify(body)});
  const text = await answer.text();
  if (!answer.ok) throw new Error(text.trim());
  return text ? JSON.parse(text) : {};
}

// What is followed, and who is told. `draw(picture)` draws one picture at once.
export class Pictures {
  constructor(draw, lost) {
    this.draw = draw;
    this.lost = lost;
    this.revision = 0;
    this.range = [0, 0];
    this.names = [];
    this.abort = null;
    this.loop();
  }

  // Looks at other rows or names; the picture of them comes at once.
  follow(range, names) {
    if (range[0] === this.range[0] && range[1] === this.range[1] && names.join() === this.names.join()) return;
    this.range = range;
    this.names = names;
    this.revision = 0;
    if (this.abort) this.abort.abort();
  }

  async loop() {
    for (;;) {
      this.abort = new AbortController();
      const query = new URLSearchParams({page, after: this.revision, from: this.range[0], to: this.range[1],
        names: this.names.slice(0, 100).join('\n')});
      try {
        const answer = await fetch('/api/picture?' + query, {signal: this.abort.signal});
        if (!answer.ok) throw new Error(await answer.text());
        const picture = await answer.json();
        this.lost(false);
        if (picture.revision > this.revision) {
          this.revision = picture.revision;
          this.draw(picture);
        }
        await new Promise(done => document.hidden ? setTimeout(done, 500) : requestAnimationFrame(done));
      } catch (error) {
        if (error.name === 'AbortError') continue;
        this.lost(true);
        this.revision = 0;
        await new Promise(done => setTimeout(done, 700));
      }
    }
  }
}
