// The playground: an editor, a picture, and a worker that runs the script between them.
import { Editor, useReference } from './editor.js';
import { View } from './picture.js';
import { css, scaleGradient } from './colors.js';
import { fromLink, toLink } from './link.js';
import { showParameters } from './parameters.js';
import { Hand, keyName, letterOf } from './hand.js';
import { drawMarks } from './marks.js';
import { fillToolbar, showKeys, showSteps, showTaken } from './toolbar.js';

const $ = id => document.getElementById(id);
const made = (tag, set = {}, ...children) => {
    const node = Object.assign(document.createElement(tag), set);
    node.append(...children);
    return node;
};
const largestFile = 400e6;
// Within a page of the site: the picture, the values and the console alone.
const embedded = new URLSearchParams(location.search).has('embed');

// ---- The open script

const state = { name: 'script.lua', values: {}, inputs: [], parameters: [], reply: null, example: null, frame: true, changed: false };
let worker = null, view = null, hand = null, editor = null, examples = [];
let runs = 0, running = 0, again = false, started = 0, waiting = new Map();

function note(text, long = false) {
    $('note').textContent = text;
    $('note').hidden = false;
    clearTimeout(note.timer);
    note.timer = setTimeout(() => { $('note').hidden = true; }, long ? 8000 : 2600);
}

// ---- The console

function print(text, className = '', line = 0) {
    const row = made('div', { className });
    if (line) row.append(made('button', { textContent: text, title: `Go to line ${line}`, onclick: () => { showPane('script'); editor.jump(line); } }));
    else row.textContent = text;
    const box = $('console'), last = box.lastElementChild;
    // Lines that a drag repeats are counted.
    if (last?.line === text && last.className === className && !line) {
        last.count = (last.count || 1) + 1;
        last.textContent = `${text}  (${last.count} times)`;
        return;
    }
    row.line = text;
    box.append(row);
    while (box.childElementCount > 2100) box.firstChild.remove();
    box.scrollTop = box.scrollHeight;
}

function lineOf(message) {
    const escaped = state.name.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');
    const match = new RegExp(`(?:^|[\\s"'\\[])${escaped}"?\\]?:(\\d+)`).exec(message);
    return match ? +match[1] : 0;
}

function showError(error) {
    const line = lineOf(error.message);
    print(error.message, 'error', line);
    if (line) editor.mark(line, error.message.replace(/^[^:]+:\d+:\s*/, ''));
    if (error.code === 'memory_limit') print('Fewer vertices or strands need less memory; a page has at most 4 GB.', 'muted');
}

// ---- The worker

function startWorker() {
    worker?.terminate();
    waiting.forEach(({ refuse }) => refuse(new Error('stopped')));
    waiting = new Map();
    worker = new Worker('worker.js', { type: 'module' });
    worker.onmessage = ({ data }) => receive[data.kind](data);
    worker.onerror = event => { event.preventDefault?.(); failedWorker(event.message || 'the worker could not be started'); };
}

function failedWorker(message) {
    busy(false);
    running = 0;
    print(`The library ended: ${message}`, 'error');
    if (hasWebAssembly()) startWorker();
    else print('This browser lacks exceptions or SIMD of WebAssembly: Chrome 95, Firefox 100, Safari 16.4 and later have them. The script stays here; Share gives a link to it for another browser.', 'muted');
}

// Whether it has what the library is made of: the least module with a catch, and that with a vector.
function hasWebAssembly() {
    const begin = [0, 97, 115, 109, 1, 0, 0, 0, 1];
    const caught = [4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 8, 1, 6, 0, 6, 64, 25, 11, 11];
    const vector = [5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11];
    return 'WebAssembly' in window && [caught, vector].every(rest => WebAssembly.validate(new Uint8Array([...begin, ...rest])));
}

function ask(message, transfer = []) {
    return new Promise((resolve, refuse) => {
        const id = ++runs;
        waiting.set(id, { resolve, refuse });
        worker.postMessage({ ...message, id }, transfer);
    });
}

const receive = {
    ready({ version, ms }) {
        state.version = version;
        window.lissomReady = ms;
    },
    failed({ message }) { failedWorker(message); },
    log({ lines }) { for (const { level, text } of lines) print(text, level === 2 ? 'warning' : level === 0 ? 'muted' : ''); },
    progress({ label, fraction }) {
        $('step').textContent = label || 'Working';
        $('bar').style.width = `${Math.round(100 * fraction)}%`;
    },
    ran(data) { finished(data); },
    picture(data) { state.reply.at = data.at; dropHand(); showPicture(data.picture, true); hand?.takeAgain(); },
    hand(data) { handAnswered(data); },
    saved(data) {
        const { resolve, refuse } = waiting.get(data.id) || {};
        waiting.delete(data.id);
        if (data.error) refuse?.(new Error(data.error)); else resolve?.(data.bytes);
    },
};

// ---- Runs

function run({ quiet = false } = {}) {
    clearTimeout(state.edits);
    if (running) { again = true; return; }
    running = ++runs;
    started = performance.now();
    editor.clear();
    $('console').replaceChildren();
    if (state.steps?.count) print('The script begins anew: changes by hand are gone.', 'muted');
    dropHand();
    worker.postMessage({ kind: 'run', id: running, script: editor.text, name: state.name, values: state.values, inputs: state.inputs,
        picture: state.wanted || state.reply?.pictures?.[state.reply.at]?.name });
    clearTimeout(run.timer);
    run.timer = setTimeout(() => busy(true), quiet ? 500 : 150);
}

function busy(is) {
    clearTimeout(run.timer);
    $('busy').hidden = !is;
    if (is) { $('step').textContent = window.lissomReady ? 'Running' : 'Loading'; $('bar').style.width = '0'; }
}

function stop() {
    if (!running && hand?.isWaiting) {
        busy(false);
        startWorker();
        run();
        print('Stopped: the script begins anew.', 'muted');
        return;
    }
    if (!running) return;
    running = 0;
    again = false;
    busy(false);
    startWorker();
    print('Stopped.', 'muted');
}

function finished(data) {
    if (data.id !== running) return;
    running = 0;
    busy(false);
    state.isLive = data.ok;
    showValues(data);
    if (data.ok) {
        state.reply = data;
        showReply(data);
        hand?.takeAgain();
    } else {
        showError(data.error);
        if (data.broken) startWorker();
        $('state').textContent = '';
    }
    window.lissomRuns = (window.lissomRuns || 0) + 1;
    window.lissomLast = { ok: data.ok, ms: data.ms, at: performance.now(), whole: performance.now() - started, memory: data.memory, error: data.error };
    if (again) { again = false; run({ quiet: true }); }
}

function showReply(data) {
    state.wanted = null;
    const seconds = data.ms / 1000;
    $('state').textContent = `${seconds < 10 ? seconds.toFixed(2) : seconds.toFixed(1)} s`;
    if (data.files.length) print(`Files: ${data.files.map(file => file.name).join(', ')}`, 'muted');
    if (!data.picture) {
        if (!$('console').childElementCount) print('Done. Return a mesh, strands or a scene to see it.', 'muted');
        return;
    }
    $('pictures-label').hidden = data.pictures.length < 2;
    $('pictures').replaceChildren(...data.pictures.map(({ name }, i) => made('option', { value: i, textContent: name, selected: i === data.at })));
    showPicture(data.picture, state.frame);
    state.frame = false;
}

function showPicture(picture, frame) {
    state.picture = picture;
    if (!view) return;
    view.show(picture, frame);
    showCounts(picture);
    showLegend(picture);
}

function showCounts(picture) {
    const vertices = picture.meshes.filter(mesh => !mesh.raised).reduce((sum, mesh) => sum + mesh.vertexCount, 0), hairs = picture.strands.reduce((sum, one) => sum + one.count, 0);
    const parts = [];
    if (vertices) parts.push(`${vertices.toLocaleString('en')} vertices`);
    if (hairs) parts.push(`${hairs.toLocaleString('en')} strands`);
    $('counts').textContent = parts.join(' · ');
}

function showLegend(picture) {
    const parts = new Map(picture.meshes.flatMap(mesh => mesh.legend.map(one => [one.name, one.color])));
    const rows = [...parts].map(([name, color]) => made('div', { className: 'part' }, made('i', { style: `background: ${css(color)}` }), name.replaceAll('_', ' ')));
    const range = picture.meshes.find(mesh => mesh.range)?.range;
    const digits = x => Math.abs(x) >= 1000 || (x !== 0 && Math.abs(x) < 0.001) ? x.toExponential(1) : String(+x.toPrecision(3));
    if (range) rows.push(made('div', { className: 'scale' }, made('i', { style: `background: ${scaleGradient}` }), made('b', { textContent: digits(range[1]) }), made('b', { textContent: digits(range[0]) })));
    $('legend').replaceChildren(...rows);
    $('legend').hidden = rows.length === 0;
}

function showCaptions(cells) {
    const rows = cells.filter(cell => cell.caption).map(cell => made('span', { textContent: cell.caption, style: `left: ${100 * (cell.x + cell.w / 2)}%; bottom: calc(${100 * cell.y}% + 52px)` }));
    $('captions').replaceChildren(...rows);
}

// ---- Tools

// The document of the hand is gone: another one follows, or none.
function dropHand() {
    hand?.reset();
    Object.assign(state, { steps: null, marks: null, toolForm: '' });
    $('hand').hidden = true;
    showSteps($('toolbar'), state.steps);
    view?.ask();
}

function postToHand(message) {
    hand.id = ++runs;
    worker.postMessage({ kind: 'hand', id: hand.id, ...message });
    clearTimeout(run.timer);
    run.timer = setTimeout(() => { $('step').textContent = 'Working'; busy(true); }, 400);
}

function handAnswered(data) {
    if (data.id !== hand.id || running) return;
    busy(false);
    // After a failure of the library itself the script begins anew.
    if (data.broken) {
        startWorker();
        run();
        showFailures(data.failures);
        return;
    }
    if (data.picture) showHand(data);
    showFailures(data.failures);
    hand.last = data;
    hand.answered();
}

function showFailures(failures) {
    for (const one of Array.isArray(failures) ? failures : []) {
        print(one.message, 'error', lineOf(one.message));
        note(one.message.replace(/^[^\s:]+:\d+:\s*/, ''), true);
    }
}

function showHand(data) {
    Object.assign(state, { marks: data.marks, steps: data.steps });
    state.picture = view.update(data.picture);
    askMarks();
    if (data.camera) view.seeBy(data.camera);
    showCounts(state.picture);
    $('legend').hidden = true;
    showSteps($('toolbar'), state.steps);
    showTool(data);
}

// Values of the tool in place of those of the script, unless they are as the form has them.
function showTool(data) {
    $('hand').hidden = !data.tool;
    if ($('prompt').textContent !== (data.prompt || '')) delete $('hand').dataset.read;
    $('prompt').textContent = data.prompt || '';
    const list = Array.isArray(data.parameters) ? data.parameters : [], form = JSON.stringify([data.tool, list]);
    if (form === state.toolForm) return;
    state.toolForm = form;
    if (data.tool !== state.shownTool) setTimeout(() => view.fitAgain());
    state.shownTool = data.tool;
    if (!data.tool) return showScriptForm();
    $('parameters').hidden = !showParameters($('parameters'), list, {}, (name, value) => {
        const one = list.find(each => each.name === name);
        one.value = value;
        state.toolForm = JSON.stringify([data.tool, list]);
        hand.set(name, value);
    });
}

function takeTool(name) {
    showTaken($('toolbar'), name);
    showKeys($('keys'), hand, name);
    $('canvas').dataset.tool = name;
    hand.take(name);
}

const isTyped = target => target.closest?.('input:not([type=range], [type=checkbox]), select, textarea, .cm-editor, [contenteditable]');

// Keys that no field has are the hand's.
function takeKey(event) {
    if (!hand || event.defaultPrevented || isTyped(event.target)) return;
    const letter = letterOf(event);
    if ((event.ctrlKey || event.metaKey) && !event.altKey) {
        const kind = letter === 'y' || (letter === 'z' && event.shiftKey) ? 'redo' : letter === 'z' ? 'undo' : '';
        if (!kind || !state.steps) return;
        event.preventDefault();
        hand.travel(kind);
        return;
    }
    if (!hand.isActive || !document.activeElement?.closest('#picture, body') || event.target.closest?.('button') && event.key !== 'Escape') return;
    if (event.key === 'Alt' && hand.pointer !== null) event.preventDefault();
    const key = keyName(event);
    if (!key || (key === 'tab' && event.shiftKey)) return;
    event.preventDefault();
    hand.key(key, { shift: event.shiftKey, alt: event.altKey });
}

function listenForHand() {
    hand = new Hand(view, postToHand);
    hand.isBlocked = () => running !== 0 || !state.isLive || !state.reply?.picture;
    Object.defineProperty(hand, 'at', { get: () => state.reply.at });
    fillToolbar($('toolbar'), { take: takeTool, travel: kind => hand.travel(kind) });
    $('canvas').addEventListener('pointerleave', () => { hand.isAway = true; askMarks(); });
    $('canvas').addEventListener('pointerdown', () => { $('canvas').focus({ preventScroll: true }); $('hand').dataset.read = ''; });
    document.addEventListener('keydown', takeKey);
    // After a click the keys are the tool's; after Enter on a button they stay there.
    for (const box of ['toolbar', 'keys']) $(box).addEventListener('click', event => { if (event.detail > 0) $('canvas').focus({ preventScroll: true }); });
}

// The marks alone, in the next frame: a picture with hair takes longer.
function askMarks() {
    if (!state.marksAsked && !view.asked) state.marksAsked = requestAnimationFrame(showMarks);
}

function showMarks() {
    state.marksAsked = 0;
    drawMarks($('marks'), state.marks, { project: (x, y, z) => view.project(x, y, z), isAway: hand.isAway, ...covered() });
}

// After each frame of the picture.
function drawn(cells) {
    showCaptions(cells);
    if (!hand) return;
    showMarks();
    hand.drawn();
}

// ---- Values

function showScriptForm() {
    $('parameters').hidden = !showParameters($('parameters'), state.parameters, state.values, setValue);
}

function setValue(name, value) {
    state.values[name] = value;
    state.changed = true;
    keep();
    run({ quiet: true });
}

function showValues(data) {
    if (!data.parameters.length && !data.ok) return;
    const key = JSON.stringify(data.parameters.map(({ value, ...one }) => one));
    if (key === state.schema) return;
    state.schema = key;
    state.parameters = data.parameters;
    const names = new Set(data.parameters.map(one => one.name));
    for (const name of Object.keys(state.values)) if (!names.has(name)) delete state.values[name];
    if (!hand?.tool) showScriptForm();
}

// ---- Scripts

function openScript({ script, values = {}, name = 'script.lua', frame = true, picture = null }) {
    Object.assign(state, { name, values: { ...values }, frame, schema: null, wanted: picture });
    editor.text = script;
    $('parameters').hidden = true;
    if (running) stop();
    run();
}

async function openExample(name) {
    const example = examples.find(one => one.name === name);
    if (!example) return;
    state.example = name;
    state.changed = false;
    history.replaceState(null, '', `#${name}`);
    const response = await fetch(`examples/${example.file}`);
    if (!response.ok) return note(`The example ${name} is not there.`);
    openScript({ script: await response.text(), values: example.values, name: example.file.split('/').pop(), picture: example.picture });
    $('examples').value = name;
}

// A script of the site's gallery, which lies beside the page; false if there is none of this name.
async function openOfGallery(name) {
    const response = await fetch(`gallery/${name}.json`).catch(() => null);
    if (!response?.ok) return false;
    const { s, v, n, p } = await response.json();
    Object.assign(state, { example: null, changed: false, reply: null });
    $('examples').selectedIndex = -1;
    openScript({ script: s, values: v, name: n, picture: p });
    return true;
}

// The work is kept in this browser until another visit; that of a frame in another page is not.
function keep() {
    if (embedded) return;
    clearTimeout(keep.timer);
    keep.timer = setTimeout(() => {
        try { localStorage.setItem('lissom.script', JSON.stringify({ script: editor.text, values: state.values, name: state.name })); } catch { /* A private window keeps nothing. */ }
    }, 400);
}

function kept() {
    try { return JSON.parse(localStorage.getItem('lissom.script')); } catch { return null; }
}

async function openFirst() {
    const mark = decodeURIComponent(location.hash.slice(1));
    if (mark.startsWith('s=')) {
        try {
            openScript(await fromLink(mark.slice(2)));
            return;
        } catch {
            note('The link is not whole: it may have been cut when it was copied. The first example is shown.', true);
        }
    }
    if (/^gallery\/\w[\w.-]*$/.test(mark)) {
        if (await openOfGallery(mark.slice(8))) return;
        note('The gallery has no script of this name. The first example is shown.', true);
    }
    if (examples.some(one => one.name === mark)) return openExample(mark);
    const old = mark === '' ? kept() : null;
    if (old?.script) { $('examples').selectedIndex = -1; openScript(old); } else await openExample(examples[0].name);
}

async function share() {
    const link = new URL(location.href);
    link.hash = `s=${await toLink({ script: editor.text, values: state.values, name: state.name })}`;
    history.replaceState(null, '', link.hash);
    window.lissomLink = link.href;
    if (link.href.length > 30000) note('The link is long: some programs cut it. It stands in the address bar.', true);
    try {
        await navigator.clipboard.writeText(link.href);
        note('The link is in the clipboard.');
    } catch {
        note('The link stands in the address bar.');
    }
}

// ---- Downloads

function give(name, content, type = 'application/octet-stream') {
    const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
    made('a', { href: url, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 30000);
    window.lissomGiven = name;
}

async function saveObject(type, object, extension) {
    try {
        give(`${state.name.replace(/\.lua$/, '')}.${extension}`, await ask({ kind: 'save', object, type, extension }));
    } catch (error) {
        note(String(error.message), true);
    }
}

function downloads() {
    const rows = [], row = (text, detail, action) => rows.push(made('button', { role: 'menuitem', onclick: () => { toggleMenu(false); action(); } }, text, made('small', { textContent: detail })));
    const { picture, reply } = state, mesh = picture?.meshes.filter(one => !one.raised).pop();
    if (mesh) {
        rows.push(made('p', { textContent: 'The mesh' }));
        for (const [extension, what] of [['obj', 'Wavefront'], ['glb', 'glTF'], ['ply', 'Stanford'], ['stl', 'for printing']]) row(`.${extension}`, what, () => saveObject('Mesh', mesh.object, extension));
    }
    if (picture?.strands.length) {
        rows.push(made('p', { textContent: 'The hair' }));
        for (const [extension, what] of [['usda', 'curves of USD'], ['hair', 'CyHair'], ['glb', 'lines of glTF']]) row(`.${extension}`, what, () => saveObject('Strands', picture.strands[0].object, extension));
    }
    if (picture) row('.png', 'the picture', async () => give(`${state.name.replace(/\.lua$/, '')}.png`, await view.png(getComputedStyle(document.documentElement).getPropertyValue('--sky').trim())));
    row('.lua', 'the script', () => give(state.name, editor.text, 'text/plain'));
    if (reply?.files?.length) {
        rows.push(made('p', { textContent: 'Files of the script' }));
        for (const file of reply.files) row(file.name.split('/').pop(), `${Math.max(1, Math.round(file.size / 1024)).toLocaleString('en')} KB`, async () => give(file.name.split('/').pop(), await ask({ kind: 'read', name: file.name })));
    }
    $('downloads').replaceChildren(...rows);
}

function toggleMenu(open) {
    if (open) downloads();
    $('downloads').hidden = !open;
    $('download').setAttribute('aria-expanded', String(open));
}

// ---- Files that are dropped

const meshFile = /\.(obj|glb|gltf|ply|off|stl)$/i;
async function takeFiles(files) {
    const taken = [];
    for (const file of files) {
        if (file.size > largestFile) { note(`${file.name} has ${Math.round(file.size / 1e6)} MB: a page takes up to ${largestFile / 1e6} MB. The program of your system opens it.`, true); continue; }
        if (/\.lua$/i.test(file.name)) { openScript({ script: await file.text(), name: file.name }); continue; }
        state.inputs = state.inputs.filter(one => one.name !== file.name).concat({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) });
        taken.push(file.name);
    }
    const mesh = taken.find(name => meshFile.test(name));
    if (!mesh) { if (taken.length) note(`${taken.join(', ')}: scripts find it by this name.`); return; }
    const quoted = JSON.stringify(mesh);
    const open = state.parameters.find(one => one.type === 'mesh' || one.type === 'head' || (one.type === 'file' && /head|model|mesh|source/.test(one.name)));
    if (open) { state.values[open.name] = mesh; state.schema = null; run(); return; }
    openScript({ script: `local lissom = require "lissom"\n\nlocal mesh = lissom.load(${quoted})\nprint(mesh:vertex_count() .. " vertices, " .. mesh:face_count() .. " faces")\nreturn mesh\n`, name: 'script.lua' });
}

function listenForFiles() {
    let inside = 0;
    const target = window;
    target.addEventListener('dragenter', event => { if (event.dataTransfer?.types.includes('Files')) { ++inside; $('drop').hidden = false; event.preventDefault(); } });
    target.addEventListener('dragover', event => { if (event.dataTransfer?.types.includes('Files')) event.preventDefault(); });
    target.addEventListener('dragleave', () => { if (--inside <= 0) { inside = 0; $('drop').hidden = true; } });
    target.addEventListener('drop', event => {
        if (!event.dataTransfer?.files.length) return;
        event.preventDefault();
        inside = 0;
        $('drop').hidden = true;
        takeFiles([...event.dataTransfer.files]);
    });
}

// ---- The page

function showPane(name) {
    document.body.dataset.pane = name;
    for (const button of document.querySelectorAll('nav button')) button.setAttribute('aria-pressed', String(button.dataset.show === name));
    view?.ask();
}

function setTheme(theme) {
    document.documentElement.dataset.theme = theme;
    try { localStorage.setItem('lissom.theme', theme); } catch { /* as above */ }
    view?.ask();
}

function firstTheme() {
    let chosen = null;
    try { chosen = localStorage.getItem('lissom.theme'); } catch { /* as above */ }
    document.documentElement.dataset.theme = chosen || (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light');
}

function listenForDivider() {
    const divider = $('divider');
    divider.addEventListener('pointerdown', event => { divider.setPointerCapture(event.pointerId); event.preventDefault(); });
    divider.addEventListener('pointermove', event => {
        if (!divider.hasPointerCapture(event.pointerId)) return;
        const share = Math.min(Math.max(event.clientX / window.innerWidth, 0.2), 0.75);
        $('script').style.setProperty('--script', `${100 * share}%`);
    });
}

function fillExamples() {
    const groups = [...new Set(examples.map(one => one.group))];
    $('examples').replaceChildren(...groups.map(group => made('optgroup', { label: group },
        ...examples.filter(one => one.group === group).map(one => made('option', { value: one.name, textContent: one.title })))));
}

function toggle(button, key) {
    button.onclick = () => {
        view.settings[key] = !view.settings[key];
        button.setAttribute('aria-pressed', String(view.settings[key]));
        view.ask();
    };
}

function listen() {
    $('run').onclick = () => run();
    $('stop').onclick = stop;
    $('share').onclick = share;
    $('examples').onchange = () => openExample($('examples').value);
    $('pictures').onchange = () => worker.postMessage({ kind: 'select', at: +$('pictures').value });
    $('download').onclick = event => { event.stopPropagation(); toggleMenu($('downloads').hidden); };
    document.addEventListener('click', event => { if (!$('downloads').contains(event.target)) toggleMenu(false); });
    document.addEventListener('keydown', event => { if (event.key === 'Escape') { if ($('downloads').hidden && (running || !$('busy').hidden)) { event.preventDefault(); stop(); } toggleMenu(false); } });
    $('theme').onclick = () => setTheme(document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark');
    $('parameters').onsubmit = event => event.preventDefault();
    for (const button of document.querySelectorAll('nav button')) button.onclick = () => showPane(button.dataset.show);
    window.addEventListener('hashchange', openFirst);
    listenForDivider();
    listenForFiles();
    if (!view) return;
    if (!embedded) listenForHand();
    toggle($('wire'), 'wire');
    toggle($('flat'), 'flat');
    $('reset').onclick = () => { view.frame(); view.ask(); };
}

function beEmbedded() {
    document.body.dataset.embed = '';
    $('picture').append(made('a', { id: 'whole', href: `./${location.hash}`, target: '_parent', textContent: 'Open in the playground' }));
}

// Parts of the picture under the tools and their keys, and under the values where they leave it the better half.
function covered() {
    const panel = $('parameters').offsetWidth + 24, left = $('toolbar').offsetWidth ? $('toolbar').offsetLeft + $('toolbar').offsetWidth : 0;
    const isBeside = !matchMedia('(max-width: 760px)').matches && !$('parameters').hidden && 2 * panel <= $('canvas').clientWidth;
    const keys = $('keys').offsetHeight;
    return { left, right: isBeside ? panel : 0, bottom: keys ? keys + 58 : 0 };
}

async function begin() {
    firstTheme();
    if (embedded) beEmbedded();
    startWorker();
    editor = new Editor($('editor'), {
        changed() {
            state.changed = true;
            keep();
            clearTimeout(state.edits);
            // A typed letter does not undo the work of the hand.
            if (state.steps?.count) $('state').textContent = 'Edited: Run begins anew';
            else state.edits = setTimeout(() => { if (!state.steps?.count && !hand?.isBusy) run({ quiet: true }); }, 900);
        },
        run: () => run(),
    });
    try {
        view = new View($('canvas'), drawn);
    } catch (error) {
        $('picture').append(made('p', { id: 'no-picture', textContent: `There is no picture: ${error.message}. Switch hardware acceleration on in its settings, or open the page in another browser. Scripts run all the same, and their files can be downloaded.` }));
    }
    if (view) view.covered = covered;
    window.lissomView = view;
    window.lissomEditor = editor;
    examples = await (await fetch('examples.json')).json();
    fillExamples();
    listen();
    window.lissomHand = hand;
    await openFirst();
    useReference(await (await fetch('reference.json')).json());
    // Offline after the first visit; at a file's address or without TLS there is none.
    if ('serviceWorker' in navigator && (location.protocol === 'https:' || location.hostname === 'localhost')) navigator.serviceWorker.register('sw.js').catch(() => {});
}

begin();
