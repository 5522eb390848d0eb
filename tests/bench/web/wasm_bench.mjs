// What a page loads and how fast it is:
//     node wasm_bench.mjs FOLDER_OF_LISSOM_WASM [PROGRAM [FOLDER_OF_PLAYGROUND]]
// Times are those of speed.lua in node beside those of the program on one thread, in turns; sizes are by brotli.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import zlib from 'node:zlib';
import { openLibrary } from '../../web/library.mjs';

const [library, program, playground] = process.argv.slice(2);
if (!library) {
    console.error('Usage: node wasm_bench.mjs FOLDER_OF_LISSOM_WASM [PROGRAM [FOLDER_OF_PLAYGROUND]]');
    process.exit(2);
}
const script = path.join(path.dirname(fileURLToPath(import.meta.url)), 'speed.lua');
const rounds = 2;

// Lines of names and seconds.
const rowsOf = text => Object.fromEntries(text.trim().split('\n').map(line => line.split('\t')).map(([name, value]) => [name, +value]));
const least = (a, b) => Object.fromEntries(Object.entries(b).map(([name, value]) => [name, Math.min(a[name] ?? Infinity, value)]));

function compressed(folder, names) {
    const bytes = names.map(name => fs.readFileSync(path.join(folder, name)))
        .map(file => zlib.brotliCompressSync(file, { params: { [zlib.constants.BROTLI_PARAM_LGWIN]: 24, [zlib.constants.BROTLI_PARAM_SIZE_HINT]: file.length } }).length);
    return bytes.reduce((a, b) => a + b, 0);
}

function showSizes() {
    const size = bytes => `${(bytes / 1e6).toFixed(2)} MB`;
    console.log(`lissom.wasm    ${size(fs.statSync(path.join(library, 'lissom.wasm')).size)}, by brotli ${size(compressed(library, ['lissom.wasm']))}`);
    if (!playground) return;
    const page = ['index.html', 'app.js', 'app.css', 'worker.js', 'lissom.mjs', 'prelude.lua', 'scripts.json', 'examples.json', 'reference.json'];
    console.log(`rest of a page by brotli ${size(compressed(playground, page))}`);
}

async function times() {
    const page = await openLibrary(library);
    let wasm = {}, native = {};
    for (let round = 0; round < rounds; ++round) {
        page.log.length = 0;
        page.run(fs.readFileSync(script, 'utf8'));
        wasm = least(wasm, rowsOf(page.log.map(text => text.replace(/\n?$/, '\n')).join('')));
        if (program) native = least(native, rowsOf(execFileSync(program, ['run', '--threads', '1', script], { encoding: 'utf8' })));
    }
    return { wasm, native };
}

showSizes();
const { wasm, native } = await times();
for (const [name, value] of Object.entries(wasm)) {
    const beside = native[name] ? ` native ${(1000 * native[name]).toFixed(1).padStart(8)} ms ${(value / native[name]).toFixed(2).padStart(6)} x` : '';
    console.log(`${name.padEnd(12)} ${(1000 * value).toFixed(1).padStart(8)} ms${beside}`);
}
