// Builds the playground into a folder that any static host serves.
//     node viewer/web/build.mjs FOLDER_OF_LISSOM_WASM OUT
// The packages of package.json are found in LISSOM_WEB_NPM, else ~/.cache/lissom/web.
import { createHash } from 'node:crypto';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url)), root = path.join(here, '..', '..');
const [library, out] = process.argv.slice(2);
if (!out) {
    console.error('Usage: node build.mjs FOLDER_OF_LISSOM_WASM OUT');
    process.exit(2);
}
const npm = process.env.LISSOM_WEB_NPM || path.join(os.homedir(), '.cache', 'lissom', 'web');
const { build } = createRequire(path.join(npm, 'package.json'))('esbuild');
const put = (name, content) => {
    const to = path.join(out, name);
    fs.mkdirSync(path.dirname(to), { recursive: true });
    fs.writeFileSync(to, content);
};
const read = name => fs.readFileSync(path.join(root, name), 'utf8');

// ---- Scripts

function luaFiles(folder) {
    return fs.readdirSync(path.join(root, folder), { withFileTypes: true }).flatMap(entry => {
        const name = `${folder}/${entry.name}`;
        if (entry.isDirectory()) return luaFiles(name);
        return entry.name.endsWith('.lua') ? [name] : [];
    });
}

function putScripts() {
    const modules = Object.fromEntries(luaFiles('scripts').map(name => [name, read(name)]));
    put('scripts.json', JSON.stringify(modules));
    const examples = JSON.parse(fs.readFileSync(path.join(here, 'examples.json'), 'utf8'));
    for (const { file } of examples) {
        const places = [path.join(here, 'examples', file), path.join(root, 'examples', file), path.join(root, 'scripts', file)];
        put(`examples/${file}`, fs.readFileSync(places.find(place => fs.existsSync(place))));
    }
    put('examples.json', JSON.stringify(examples));
}

// ---- The reference, with the fields that the editor shows

function shortReference() {
    const { functions } = JSON.parse(read('docs/lua/reference.json'));
    const row = ({ name, type, help }) => ({ name, type, help });
    return JSON.stringify({ functions: functions.map(one => ({ name: one.name, call: one.call, summary: one.summary,
        arguments: one.arguments.map(row), options: one.options.map(row) })) });
}

// ---- The page

async function bundle() {
    const shared = { bundle: true, minify: true, format: 'esm', target: 'es2022', nodePaths: [path.join(npm, 'node_modules')], legalComments: 'none', logLevel: 'warning' };
    await build({ ...shared, entryPoints: [path.join(here, 'app.js')], outfile: path.join(out, 'app.js') });
    await build({ ...shared, entryPoints: [path.join(here, 'worker.js')], outfile: path.join(out, 'worker.js'), external: ['./lissom.mjs'] });
    await build({ ...shared, entryPoints: [path.join(here, 'app.css')], outfile: path.join(out, 'app.css') });
}

function allFiles(folder = out, start = '') {
    return fs.readdirSync(folder, { withFileTypes: true }).flatMap(entry => entry.isDirectory()
        ? allFiles(path.join(folder, entry.name), `${start}${entry.name}/`) : [`${start}${entry.name}`]);
}

function putServiceWorker() {
    const files = allFiles().filter(name => name !== 'sw.js' && !/\.(br|gz)$/.test(name)).sort();
    const hash = createHash('sha256');
    for (const name of files) hash.update(name).update(fs.readFileSync(path.join(out, name)));
    const text = fs.readFileSync(path.join(here, 'sw.js'), 'utf8');
    put('sw.js', text.replace('@VERSION@', hash.digest('hex').slice(0, 12)).replace('@FILES@', JSON.stringify(['./', ...files])));
}

fs.rmSync(out, { recursive: true, force: true });
fs.mkdirSync(out, { recursive: true });
for (const name of ['lissom.mjs', 'lissom.wasm']) put(name, fs.readFileSync(path.join(library, name)));
for (const name of ['index.html', 'icon.svg', 'manifest.webmanifest', 'prelude.lua', 'hand.lua']) put(name, fs.readFileSync(path.join(here, name)));
putScripts();
put('reference.json', shortReference());
await bundle();
putServiceWorker();
