// Builds the site into a folder that any static host serves: start page, guide, reference, gallery, search, playground.
//     node viewer/web/site/build.mjs LISSOM PLAYGROUND OUT
// LISSOM is the program, which draws all pictures; they are kept in OUT/../site-pictures for the next time.
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { createRequire } from 'node:module';
import { makeRenderer, escaped } from './markdown.mjs';
import { drawExamples, drawGallery, runnable } from './pictures.mjs';
import { cardHtml, liveHtml, pageHtml, sideHtml, slideHtml } from './pages.mjs';

const here = path.dirname(fileURLToPath(import.meta.url)), root = path.join(here, '..', '..', '..');
const [program, playground, out] = process.argv.slice(2).map(one => path.resolve(one));
if (!out) {
    console.error('Usage: node build.mjs LISSOM PLAYGROUND OUT');
    process.exit(2);
}
const npm = process.env.LISSOM_WEB_NPM || path.join(os.homedir(), '.cache', 'lissom', 'web');
const render = makeRenderer(npm);
const read = name => fs.readFileSync(path.join(root, name), 'utf8');
const put = (name, content) => {
    const to = path.join(out, name);
    fs.mkdirSync(path.dirname(to), { recursive: true });
    fs.writeFileSync(to, content);
};

// ---- Which Markdown becomes which page

const markdown = folder => fs.readdirSync(path.join(root, folder)).filter(name => name.endsWith('.md')).map(name => `${folder}/${name}`);
const pages = new Map([['README.md', 'guide/index.html']]);
for (const file of markdown('docs/guide')) pages.set(file, `guide/${path.basename(file, '.md')}.html`);
for (const file of markdown('docs')) pages.set(file, `guide/${path.basename(file, '.md')}.html`);
pages.set('bindings/python/README.md', 'guide/python.html');
for (const file of markdown('docs/lua')) pages.set(file, `reference/${path.basename(file, '.md') === 'README' ? 'index' : path.basename(file, '.md')}.html`);

// ---- The gallery

const gallery = JSON.parse(read('viewer/web/site/gallery.json'));
const levels = { easy: 'Easy', medium: 'Medium', advanced: 'Advanced' };
const firstSentence = text => {
    const lines = [];
    for (const line of text.split('\n')) {
        const comment = /^---?\s?(.*)$/.exec(line);
        if (!comment || !comment[1].trim() || /^\s{3,}/.test(comment[1])) break;
        lines.push(comment[1].trim());
    }
    return lines.join(' ').replace(/\s*\(Figure [\d.]+\)/, '').replace(/(\.|:)\s.*$/s, '$1').replace(/:$/, '.');
};
const taken = new Set();
for (const one of gallery) {
    const base = path.basename(one.file, '.lua');
    let id = base, n = 1;
    while (taken.has(id)) id = `${base}-${++n}`;
    taken.add(id);
    one.id = id;
    one.script = read(one.file);
    one.text ||= firstSentence(one.script);
}
const galleryOf = file => gallery.find(one => one.file === file);

// ---- Pages of Markdown

const copied = new Map();
function addressOf(from, href) { // the address in the site, from the page of `from`, or null
    if (/^(https?:|mailto:|#)/.test(href)) return href;
    const [name, mark] = href.split('#'), file = path.posix.normalize(path.posix.join(path.posix.dirname(from), decodeURI(name)));
    const up = '../', tail = mark ? `#${mark}` : '';
    if (pages.has(file)) return up + pages.get(file) + tail;
    const shown = galleryOf(file);
    if (shown) return `${up}gallery.html#${shown.id}`;
    if (/^(scripts\/(presets|recipes)|examples(\/\w+)?)\/?$/.test(file)) return `${up}gallery.html`;
    const whole = path.join(root, file);
    if (!fs.existsSync(whole) || !fs.statSync(whole).isFile()) return null;
    const to = /\.(png|svg)$/.test(file) ? `files/${file}` : `files/${file}.txt`;
    copied.set(to, whole);
    return up + to;
}

const scripts = [];     // every example of guide and reference: { id, page, code, ... }
const search = [];

function collectExamples() {
    for (const [file, page] of pages) {
        const counts = new Map();
        render(read(file), { link: () => null, image: () => null, example: (code, anchor) => {
            const start = `${page.split('/')[0] === 'reference' ? '' : 'guide.'}${path.basename(page, '.html')}${anchor && page.startsWith('reference') ? `.${anchor}` : ''}`;
            const count = (counts.get(start) || 0) + 1;
            counts.set(start, count);
            scripts.push({ id: count > 1 ? `${start}-${count}` : start, file, page, anchor, code, reference: page.startsWith('reference/') });
        } });
    }
}

function runHtml(script) {
    if (!script.play) return '';
    const picture = script.picture ? `<img src="../pictures/${script.id}.png" alt="Picture that this example draws" loading="lazy" width="480" height="360">` : '';
    return `<div class="run"><button type="button" data-run="${script.id}">Run</button><a href="../playground/#gallery/${script.id}">Open in the playground</a></div>${picture ? `<div class="shown">${picture}</div>` : ''}`;
}

function makePages(side) {
    for (const [file, page] of pages) {
        const own = scripts.filter(script => script.file === file);
        let at = 0;
        const text = file === 'README.md' ? read(file).replace(/\n## Licence[\s\S]*$/, '\n') : read(file);
        const { html, sections } = render(text, { link: href => addressOf(file, href), image: href => addressOf(file, href), example: () => runHtml(own[at++]) });
        const title = sections[0]?.title || page;
        put(page, pageHtml({ title, body: `<article class="text">${html}</article>`, side: side(page), up: '../', here: page }));
        const kind = page.startsWith('reference/') ? 'Reference' : 'Guide';
        for (const section of sections) {
            if (section.depth > 3 || kind === 'Reference' && section.depth === 2) continue;
            search.push({ t: section.title, s: section.depth === 1 ? kind : `${kind} · ${title}`, u: page + (section.id ? `#${section.id}` : ''), x: section.text.trim().slice(0, 160) });
        }
    }
}

// The pages of the guide in the order of README's table, then all others.
function guideSide() {
    const rows = read('README.md').split('\n## Next steps')[1].split('\n## ')[0].split('\n').filter(row => /^\| (?!You|---)/.test(row));
    const groups = [{ title: 'Guide', links: [['guide/index.html', 'Overview']] }], known = new Set(['guide/index.html']);
    for (const row of rows) {
        const [, name, links] = row.split('|');
        const own = [...links.matchAll(/\[([^\]]+)\]\(([^)#]+)/g)].map(([, text, href]) => [pages.get(href), text[0].toUpperCase() + text.slice(1)]).filter(([page]) => page);
        own.forEach(([page]) => known.add(page));
        if (own.length) groups.push({ title: `You ${name.trim()}`, links: own });
    }
    const rest = [...pages].filter(([file, page]) => page.startsWith('guide/') && !known.has(page)).map(([file, page]) => [page, /^# (.+)$/m.exec(read(file))[1]]);
    if (rest.length) groups.push({ title: 'More', links: rest });
    return groups;
}

function referenceSide() {
    const links = [...pages].filter(([, page]) => page.startsWith('reference/')).map(([file, page]) => [page, /^# (.+)$/m.exec(read(file))[1].replace(/^lissom\.(?=[A-Z])/, '')]);
    const first = links.filter(([page]) => page === 'reference/index.html' || page === 'reference/lissom.html');
    return [{ title: 'Reference', links: [...first, ...links.filter(one => !first.includes(one))] }];
}

// ---- Gallery and start

const shownReference = () => {
    const seen = new Set();
    return scripts.filter(script => script.reference && script.picture && !seen.has(script.picture) && seen.add(script.picture));
};

function referenceCard(script) {
    const found = functions.get(script.id.replace(/-\d+$/, '')) || {};
    return { id: script.id, title: found.call || script.id, text: found.summary || '', level: 'easy', group: 'Reference', more: `${script.page}#${script.anchor}` };
}

const functions = new Map(JSON.parse(read('docs/lua/reference.json')).functions.map(one => [one.name.replace(/^lissom\./, '').split('.').length > 1
    ? one.name.replace(/^lissom\./, '').replace(/^\w/, letter => letter.toLowerCase()) : `lissom.${one.name.replace(/^lissom\./, '')}`, one]));

function makeGallery() {
    const cards = [...gallery, ...shownReference().map(referenceCard)];
    const groups = [...new Set(cards.map(one => one.group))];
    const body = `<section class="gallery"><h1>Gallery</h1><p class="lead">${cards.length} scripts with the pictures that they draw. Each opens in the playground, where every value can be changed.</p>
<div class="filters" role="group" aria-label="Filters"><button type="button" data-group="" aria-pressed="true">All</button>${groups.map(group => `<button type="button" data-group="${escaped(group)}" aria-pressed="false">${escaped(group)}</button>`).join('')}<span></span>${Object.entries(levels).map(([level, name]) => `<button type="button" data-level="${level}" aria-pressed="false">${name}</button>`).join('')}</div>
${groups.map(group => `<section data-group="${escaped(group)}"><h2>${escaped(group)}</h2><div class="cards">${cards.filter(one => one.group === group).map(one => cardHtml(one, levels)).join('')}</div></section>`).join('\n')}
<p class="none" hidden>None of these.</p></section>`;
    put('gallery.html', pageHtml({ title: 'Gallery', body, up: '', here: 'gallery.html' }));
    for (const one of gallery) search.push({ t: one.title, s: `Gallery · ${one.group}`, u: `gallery.html#${one.id}`, x: one.text });
    return cards.length;
}

function makeStart(count) {
    const live = [['bend', 'Bend', 'Pin a region, turn another: the surface between follows, with all its details.'],
        ['join', 'Merge', 'Two open boundaries become one seam; the part is turned, scaled and deformed to fit.'],
        ['groom', 'Groom', 'A few curves make the directions of a whole head of hair.']];
    const strip = ['ponytail', 'scatter', 'ringlets', 'figure_2_11', 'crown_braid', 'figure_3_5', 'mohawk', 'attach', 'waves', 'sphinx', 'cornrows', 'figure_3_4']
        .map(id => gallery.find(one => one.id === id)).filter(Boolean);
    const { html } = render(`\`\`\`lua\n${read('README.md').split('## Bend')[1].split('```lua\n')[1].split('```')[0].replace(/ +--.*$/gm, '')}\`\`\``, { link: () => null, image: () => null, example: () => '' });
    const body = `<section class="hero"><div><h1>Shapes that follow a few handles</h1><p>Lissom is a modeling kernel for detailed shapes. It bends scans and sculpts, merges parts into one surface, and styles heads of 100,000 hairs, by short scripts in Lua: in this page, in your engine, in Blender, or over a folder of files.</p>
<p class="actions"><a class="main" href="playground/">Open the playground</a><a href="guide/scripts.html">First script</a><a href="gallery.html">Gallery of ${count}</a></p></div>${html}</section>
<section class="lives">${live.map(([id, title, text]) => liveHtml(gallery.find(one => one.id === id), title, text)).join('')}</section>
<section class="strip"><h2>From the gallery</h2><div class="cards small">${strip.map(slideHtml).join('')}</div><p><a href="gallery.html">All ${count}</a></p></section>
<section class="facts"><div><h3>One library</h3><p>C++20 with a C ABI; Lua 5.4 or the LuaJIT of your engine; <a href="guide/python.html">Python</a>, <a href="guide/blender.html">Blender</a>, <a href="guide/embed_lua.html">LÖVE</a>, <a href="guide/browser.html">browsers</a>.</p></div>
<div><h3>The same everywhere</h3><p>A script gives the same result in <a href="guide/hosts.html">every host</a>. Errors have codes, ids and a remedy, and leave everything as it was.</p></div>
<div><h3>Free</h3><p>The code is under the MIT licence. <a href="guide/licence.html">Contents of a binary</a>.</p></div></section>`;
    put('index.html', pageHtml({ title: 'Lissom', body, up: '', here: 'index.html' }));
}

// ---- All together

// `page` are values for pages alone: hair as text takes longer to save there than to grow.
function putPlaygroundScripts() {
    const folder = 'playground/gallery';
    for (const one of gallery) put(`${folder}/${one.id}.json`, JSON.stringify({ s: one.script, v: { ...one.values, ...one.page }, n: path.basename(one.file), p: one.picture }));
    for (const one of scripts) if (one.play) put(`${folder}/${one.id}.json`, JSON.stringify({ s: one.play, v: {}, n: `${one.id.replace(/[^\w]+/g, '_')}.lua` }));
}

fs.rmSync(out, { recursive: true, force: true });
fs.mkdirSync(out, { recursive: true });
const kept = path.join(path.dirname(out), 'site-pictures');
collectExamples();
drawGallery({ program, root, kept, gallery });
drawExamples({ program, root, kept, scripts: scripts.filter(runnable) });
fs.mkdirSync(path.join(out, 'pictures'), { recursive: true });
for (const one of [...gallery, ...scripts]) if (one.picturePath) fs.copyFileSync(one.picturePath, path.join(out, 'pictures', `${one.id}.png`));
const guide = guideSide(), reference = referenceSide();
makePages(page => sideHtml(page.startsWith('guide/') ? guide : reference, page));
const count = makeGallery();
makeStart(count);
for (const [to, from] of copied) put(to, fs.readFileSync(from));
fs.cpSync(playground, path.join(out, 'playground'), { recursive: true });
putPlaygroundScripts();
put('search.json', JSON.stringify(search));
put('icon.svg', read('viewer/web/icon.svg'));
const { build } = createRequire(path.join(npm, 'package.json'))('esbuild');
for (const name of ['site.js', 'site.css']) await build({ entryPoints: [path.join(here, name)], outfile: path.join(out, name), minify: true, target: 'es2022', logLevel: 'warning' });
console.log(`${pages.size} pages, ${count} pictures in the gallery, ${scripts.filter(one => one.play).length} of ${scripts.length} examples run in place`);
