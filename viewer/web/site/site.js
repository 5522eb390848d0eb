// Behaviour of the pages: theme, search, filters of the gallery, examples that run in place.
const up = document.documentElement.dataset.up || '';

// ---- Light and dark

document.getElementById('theme').onclick = () => {
    const root = document.documentElement;
    const dark = root.dataset.theme ? root.dataset.theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
    root.dataset.theme = dark ? 'light' : 'dark';
    try { localStorage.setItem('lissom.theme', root.dataset.theme); } catch { /* A private window keeps nothing. */ }
};

// The list of pages stands open beside the text, and closed above it on a phone.
const side = document.querySelector('.side');
if (side) {
    const wide = matchMedia('(min-width: 900px)');
    const follow = () => { side.open = wide.matches; };
    follow();
    wide.addEventListener('change', follow);
    const current = side.querySelector('[aria-current=page]');
    if (wide.matches && current) side.scrollTop = current.offsetTop - side.clientHeight / 2;
}

// ---- Search

const form = document.querySelector('.search'), field = form.querySelector('input'), found = form.querySelector('.found');
let index = null, chosen = 0;

async function load() {
    index ||= fetch(`${up}search.json`).then(answer => answer.json()).then(rows => rows.map(row => ({ ...row, low: row.t.toLowerCase(), all: `${row.t} ${row.s} ${row.x}`.toLowerCase() })));
    return index;
}

// How well a row fits all words; 0 if one of them is missing.
function fit(row, words) {
    let sum = row.s === 'Guide' || row.s === 'Reference' ? 0.5 : 0;
    for (const word of words) {
        if (!row.all.includes(word)) return 0;
        const name = row.low.replace(/[({].*$/, ''), last = name.split(/[.:\s]/).pop();
        sum += name === word || last === word ? 12 : name.startsWith(word) || last.startsWith(word) ? 7 : row.low.includes(word) ? 4 : 1;
    }
    return sum - row.t.length / 200;
}

function element(tag, set, ...children) {
    const made = Object.assign(document.createElement(tag), set);
    made.append(...children);
    return made;
}

async function searchFor(text) {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    if (!words.length) { found.hidden = true; return; }
    const rows = (await load()).map(row => [fit(row, words), row]).filter(([points]) => points > 0).sort((a, b) => b[0] - a[0]).slice(0, 12);
    if (text !== field.value) return;
    found.replaceChildren(...rows.map(([, row]) => element('a', { href: up + row.u, role: 'option' }, element('b', { textContent: row.t }), element('small', { textContent: row.s }), element('span', { textContent: row.x }))));
    if (!rows.length) found.append(element('p', { textContent: 'Nothing found.' }));
    found.hidden = false;
    choose(0);
}

function choose(at) {
    const rows = [...found.querySelectorAll('a')];
    if (!rows.length) return;
    chosen = (at + rows.length) % rows.length;
    rows.forEach((row, i) => row.setAttribute('aria-selected', String(i === chosen)));
    rows[chosen].scrollIntoView({ block: 'nearest' });
}

field.addEventListener('input', () => searchFor(field.value));
field.addEventListener('focus', () => { load(); if (field.value) searchFor(field.value); });
field.addEventListener('keydown', event => {
    if (event.key === 'ArrowDown' || event.key === 'ArrowUp') { event.preventDefault(); choose(chosen + (event.key === 'ArrowDown' ? 1 : -1)); }
    if (event.key === 'Escape') { found.hidden = true; field.blur(); }
});
form.addEventListener('submit', event => { event.preventDefault(); found.querySelectorAll('a')[chosen]?.click(); });
document.addEventListener('click', event => { if (!form.contains(event.target) || event.target.closest('.found a')) found.hidden = true; });
document.addEventListener('keydown', event => {
    if (event.key === '/' && !/INPUT|TEXTAREA|SELECT/.test(document.activeElement.tagName)) { event.preventDefault(); field.focus(); }
});

// ---- The gallery

const filters = document.querySelector('.filters');
if (filters) {
    const state = { group: '', level: '' };
    const show = () => {
        let any = false;
        for (const section of document.querySelectorAll('section[data-group]')) {
            let count = 0;
            for (const card of section.querySelectorAll('.card')) {
                card.hidden = state.level !== '' && card.dataset.level !== state.level;
                count += !card.hidden;
            }
            section.hidden = count === 0 || state.group !== '' && section.dataset.group !== state.group;
            any ||= !section.hidden;
        }
        document.querySelector('.none').hidden = any;
        for (const button of filters.querySelectorAll('button')) button.setAttribute('aria-pressed', String('group' in button.dataset ? button.dataset.group === state.group : button.dataset.level === state.level));
    };
    filters.addEventListener('click', ({ target }) => {
        if ('group' in target.dataset) state.group = target.dataset.group;
        if ('level' in target.dataset) state.level = state.level === target.dataset.level ? '' : target.dataset.level;
        show();
    });
}

// ---- Examples that run in place

function playground(id) {
    return element('iframe', { src: `${up}playground/?embed#gallery/${id}`, title: `The example ${id}, running`, className: 'playground', allow: 'clipboard-write' });
}

for (const button of document.querySelectorAll('[data-live]')) {
    button.onclick = () => button.parentElement.replaceChildren(playground(button.dataset.live));
}

for (const button of document.querySelectorAll('[data-run]')) {
    button.onclick = () => {
        const row = button.closest('.run'), open = row.parentElement.querySelector('iframe');
        row.parentElement.querySelector('.shown')?.toggleAttribute('hidden', !open);
        if (open) open.remove(); else row.after(playground(button.dataset.run));
        button.textContent = open ? 'Run' : 'Close';
    };
}
