// Pictures of the gallery and of the examples, drawn by the program, and kept for the next time under a hash of all that
// they depend on.
import { createHash } from 'node:crypto';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';

const filesIn = (folder, ending) => fs.readdirSync(folder, { withFileTypes: true }).flatMap(entry => {
    const one = path.join(folder, entry.name);
    return entry.isDirectory() ? filesIn(one, ending) : entry.name.endsWith(ending) ? [one] : [];
}).sort();

const hashes = new Map();
function hashOf(parts) {
    const hash = createHash('sha256');
    for (const part of parts) hash.update(part).update('\0');
    return hash.digest('hex').slice(0, 24);
}
function stateOf(program, root) { // of the program and of the modules that scripts load
    const key = `${program} ${root}`;
    if (!hashes.has(key)) hashes.set(key, hashOf([fs.readFileSync(program), ...filesIn(path.join(root, 'scripts'), '.lua').map(file => fs.readFileSync(file))]));
    return hashes.get(key);
}

function inFolder(work) {
    const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'lissom-site-'));
    try { return work(folder); } finally { fs.rmSync(folder, { recursive: true, force: true }); }
}

function runProgram(program, script, more, environment, folder) {
    const done = spawnSync(program, ['run', script, ...more], { cwd: folder, env: { ...process.env, ...environment }, encoding: 'utf8', maxBuffer: 1 << 26, timeout: 600000 });
    if (done.status !== 0) throw new Error(`${path.basename(script)} ${JSON.stringify(environment)} ${more.join(' ')}\n${done.stdout?.slice(-2000)}${done.stderr?.slice(-4000)}${done.error || ''}`);
}

// Sets picturePath of each.
export function drawGallery({ program, root, kept, gallery }) {
    const drawer = path.join(root, 'viewer/web/site/picture.lua'), state = hashOf([stateOf(program, root), fs.readFileSync(drawer)]);
    fs.mkdirSync(kept, { recursive: true });
    gallery.forEach((one, i) => {
        const values = Object.entries(one.values || {}).flatMap(([name, value]) => [`--${name}`, String(value)]);
        one.picturePath = path.join(kept, `${hashOf([state, one.script, one.picture || '', one.saved || '', ...values])}.png`);
        if (fs.existsSync(one.picturePath)) return;
        console.error(`site: picture ${i + 1} of ${gallery.length}: ${one.title}`);
        inFolder(folder => {
            const made = path.join(folder, 'site-picture.png');
            runProgram(program, drawer, values, { SITE_SCRIPT: path.join(root, one.file), SITE_PICTURE: made, ...(one.picture ? { SITE_NAME: one.picture } : {}), ...(one.saved ? { SITE_SAVED: one.saved } : {}) }, folder);
            fs.copyFileSync(made, one.picturePath);
        });
    });
}

// An example that begins and ends by itself. Those of tests and of tools in the window have another host.
export const runnable = ({ code, reference }) => reference || /require\s*\(?["']lissom["']/.test(code) && !/^\s*(test|describe)\(/m.test(code);

const withHeader = code => /require\s*\(?\s*["']lissom["']/.test(code) ? code : `local lissom = require "lissom"\n\n${code}`;
const localsOf = code => [...new Set([...code.matchAll(/^local\s+([\w\s,<>]+?)\s*(=|$)/gm)].flatMap(([, names]) => names.split(',').map(name => name.replace(/<.*>/, '').trim())))]
    .filter(name => /^[A-Za-z_]\w*$/.test(name) && name !== 'lissom' && name !== 'function');

function readResults(folder, state) {
    const answers = new Map();
    for (const line of fs.readFileSync(path.join(folder, 'results.txt'), 'utf8').split('\n')) {
        const [id, status, call] = line.split('\t');
        if (id) answers.set(id, { ok: status === 'ok', call: (call || '').replace(/\\n/g, '\n') });
    }
    return answers;
}

// Sets play, the script that a page runs, and picture and picturePath, if it draws something.
export function drawExamples({ program, root, kept, scripts }) {
    const drawer = path.join(root, 'viewer/web/site/examples.lua');
    const folder = path.join(kept, `examples-${hashOf([stateOf(program, root), fs.readFileSync(drawer), ...scripts.map(one => `${one.id}\n${one.code}`)])}`);
    for (const one of scripts) one.text = withHeader(one.code.trimEnd());
    if (!fs.existsSync(path.join(folder, 'results.txt'))) {
        console.error(`site: ${scripts.length} examples`);
        for (const name of fs.readdirSync(kept)) if (name.startsWith('examples-')) fs.rmSync(path.join(kept, name), { recursive: true });
        fs.mkdirSync(folder, { recursive: true });
        for (const one of scripts) fs.writeFileSync(path.join(folder, `${one.id}.lua`), one.text);
        fs.writeFileSync(path.join(folder, 'list.lua'), `return {\n${scripts.map(one => `    { id = ${JSON.stringify(one.id)}, names = { ${localsOf(one.code).map(name => JSON.stringify(name)).join(', ')} } },`).join('\n')}\n}\n`);
        inFolder(work => runProgram(program, drawer, [], { SITE_FOLDER: folder }, work));
    }
    const answers = readResults(folder);
    for (const one of scripts) {
        const answer = answers.get(one.id);
        if (!answer?.ok) { one.failure = answer?.call || 'not run'; continue; }
        one.play = `${one.text}\n${answer.call ? `\n${answer.call}\n` : ''}`;
        if (!answer.call) continue;
        one.picturePath = path.join(folder, `${one.id}.png`);
        one.picture = createHash('sha256').update(fs.readFileSync(one.picturePath)).digest('hex');
    }
}
