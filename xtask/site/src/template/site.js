// The theme before the page is drawn; then the list of pages on narrow screens, and the search.
(function () {
  'use strict';

  const THEMES = ['', 'light', 'dark'];
  const SHOWN = 30;

  function stored() {
    try { return localStorage.getItem('theme') ?? ''; } catch { return ''; }
  }

  function store(theme) {
    try { localStorage.setItem('theme', theme); } catch { /* pages of a disk may have no storage */ }
  }

  function setTheme(theme) {
    if (theme === '') delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = theme;
  }

  setTheme(stored());

  document.addEventListener('DOMContentLoaded', () => {
    const top = document.body.dataset.top;
    const button = document.getElementById('theme');
    const label = () => { button.lastChild.textContent = `: ${document.documentElement.dataset.theme ?? 'system'}`; };
    label();
    button.addEventListener('click', () => {
      const now = document.documentElement.dataset.theme ?? '';
      const next = THEMES[(THEMES.indexOf(now) + 1) % THEMES.length];
      setTheme(next);
      store(next);
      label();
    });

    const menu = document.getElementById('menu');
    const list = document.getElementById('list');
    menu.addEventListener('click', () => {
      menu.setAttribute('aria-expanded', String(list.classList.toggle('open')));
    });
    list.querySelector('[aria-current]')?.scrollIntoView({ block: 'nearest' });

    const words = document.getElementById('words');
    const results = document.getElementById('results');
    let loading = null;

    function load() {
      loading ??= new Promise((resolve, reject) => {
        const script = document.createElement('script');
        script.src = `${top}search.js`;
        script.onload = () => resolve(SECTIONS.map(([page, address, title, heading, text]) => ({
          page, address, title, heading, text,
          head: `${title} ${heading}`.toLowerCase(),
          all: `${title} ${heading} ${text}`.toLowerCase(),
        })));
        script.onerror = () => reject(new Error(`cannot read ${script.src}`));
        document.head.append(script);
      });
      return loading;
    }

    /** How well a section fits: 0 where a word is missing; a word in a heading counts ten times one in the text. */
    function fit(section, sought) {
      let score = 0;
      for (const word of sought) {
        if (!section.all.includes(word)) return 0;
        score += section.head.includes(word) ? 10 : 1;
        if (section.heading.toLowerCase() === word) score += 20;
      }
      return score;
    }

    /** The text around the first word, with the words marked. */
    function excerpt(section, sought) {
      const line = document.createElement('small');
      const low = section.text.toLowerCase();
      const at = Math.min(...sought.map((word) => low.indexOf(word)).filter((place) => place >= 0));
      const from = Number.isFinite(at) ? Math.max(0, at - 60) : 0;
      let rest = section.text.slice(from, from + 200);
      if (from > 0) line.append('\u2026');
      while (rest !== '') {
        const low = rest.toLowerCase();
        const found = sought.map((word) => [low.indexOf(word), word]).filter(([place]) => place >= 0);
        if (found.length === 0) break;
        const [place, word] = found.reduce((a, b) => (b[0] < a[0] ? b : a));
        const mark = document.createElement('mark');
        mark.textContent = rest.slice(place, place + word.length);
        line.append(rest.slice(0, place), mark);
        rest = rest.slice(place + word.length);
      }
      line.append(rest);
      return line;
    }

    async function search() {
      const sought = words.value.toLowerCase().split(/\s+/).filter((word) => word !== '');
      if (sought.length === 0) { results.hidden = true; return; }
      let sections;
      try { sections = await load(); } catch (error) { show([note(error.message)]); return; }
      const found = sections.map((section, place) => ({ section, place, score: fit(section, sought) }))
        .filter(({ score }) => score > 0)
        .sort((a, b) => b.score - a.score || a.place - b.place);
      const count = found.length > SHOWN ? `${found.length} sections, the first ${SHOWN}` : `${found.length} sections`;
      show([note(count), ...found.slice(0, SHOWN).map(({ section }) => {
        const link = document.createElement('a');
        link.href = top + section.page + (section.address === '' ? '' : `#${section.address}`);
        const head = document.createElement('b');
        head.textContent = section.heading === '' || section.heading === section.title ? section.title : `${section.title}: ${section.heading}`;
        link.append(head, excerpt(section, sought));
        return link;
      })]);
    }

    function note(text) {
      const line = document.createElement('p');
      line.textContent = text;
      return line;
    }

    function show(lines) {
      results.replaceChildren(...lines);
      results.hidden = false;
    }

    words.addEventListener('focus', () => { load().catch(() => {}); });
    words.addEventListener('input', search);
    document.getElementById('find').addEventListener('submit', (event) => {
      event.preventDefault();
      results.querySelector('a')?.click();
    });
    results.addEventListener('click', () => { results.hidden = true; });
    document.addEventListener('click', (event) => {
      if (!results.contains(event.target) && event.target !== words) results.hidden = true;
    });
    document.addEventListener('keydown', (event) => {
      const typing = /^(INPUT|TEXTAREA|SELECT)$/.test(document.activeElement?.tagName ?? '');
      if (event.key === '/' && !typing) { event.preventDefault(); words.focus(); }
      if (event.key === 'Escape') { results.hidden = true; words.blur(); }
      if (event.key === 'ArrowDown' && !results.hidden) {
        const links = [...results.querySelectorAll('a')];
        const next = links[links.indexOf(document.activeElement) + 1];
        if (next) { event.preventDefault(); next.focus(); }
      }
    });
  });
})();
