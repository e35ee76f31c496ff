// The search of a page, which is complete without it.
(function() {
  var doc = document, all = null, hits = [], at = -1, wait = 0;
  var bar = doc.createElement('form'), input = doc.createElement('input'), note = doc.createElement('output');
  bar.id = 'find';
  bar.setAttribute('role', 'search');
  input.type = 'search';
  input.placeholder = 'Rung number, name, address or text';
  input.setAttribute('aria-label', input.placeholder);
  input.setAttribute('aria-keyshortcuts', '/');
  note.setAttribute('aria-live', 'polite');

  function button(text, step, title) {
    var b = doc.createElement('button');
    b.type = 'button';
    b.textContent = text;
    b.title = title;
    b.onclick = function() { search(); go(step); };
    return b;
  }
  bar.append(input, button('Next', 1, 'Enter'), button('Previous', -1, 'Shift and Enter'), note);
  doc.querySelector('h1').after(bar);

  // An address with and without leading zeros, X002.1 and X2.1, is the same.
  function plain(text) { return text.toLowerCase().replace(/\b([a-z])0+(?=\d)/g, '$1'); }

  function texts() {
    if (!all) all = Array.from(doc.querySelectorAll(
      'figcaption span,figcaption .f,figcaption .o,.R p,main text,main p.C,main h2,main h3,main td,main tbody th'),
      function(e) { return [e, plain(e.textContent)]; });
    return all;
  }

  function search() {
    var what = input.value.trim().toLowerCase();
    clearTimeout(wait);
    if (what === search.what) return;
    search.what = what;
    hits.forEach(function(e) { e.classList.remove('hit', 'now'); });
    hits = what ? texts().filter(function(t) { return t[1].includes(plain(what)); }).map(function(t) { return t[0]; }) : [];
    var rung = /^\d+$/.test(what) && doc.getElementById('r' + what);
    if (rung) hits.unshift(rung.querySelector('figcaption b,th'));
    hits.forEach(function(e) { e.classList.add('hit'); });
    at = -1;
    report();
  }

  function report() {
    note.textContent = !search.what ? '' : !hits.length ? 'not found' :
      at < 0 ? hits.length + (hits.length > 1 ? ' hits' : ' hit') : (at + 1) + ' of ' + hits.length;
  }

  function go(step) {
    if (!hits.length) return;
    if (at >= 0) hits[at].classList.remove('now');
    at = at < 0 && step < 0 ? hits.length - 1 : (at + step + hits.length) % hits.length;
    var e = hits[at], home = e.closest('figure,tr[id],h2,h3');
    e.classList.add('now');
    if (home && home.id) location.replace('#' + home.id);
    e.scrollIntoView({block: 'center', inline: 'nearest'});
    report();
  }

  input.oninput = function() { clearTimeout(wait); wait = setTimeout(search, 150); };
  input.onkeydown = function(e) {
    if (e.key === 'Enter') { e.preventDefault(); search(); go(e.shiftKey ? -1 : 1); }
    if (e.key === 'Escape') { input.value = ''; search(); input.blur(); }
  };
  bar.onsubmit = function(e) { e.preventDefault(); };
  doc.addEventListener('keydown', function(e) {
    if (e.key !== '/' || e.ctrlKey || e.metaKey || e.altKey || e.target === input) return;
    e.preventDefault();
    input.focus();
    input.select();
  });
})();
