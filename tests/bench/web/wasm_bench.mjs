// What a page loads, how soon it shows a picture, and how fast it is, as rows of a benchmark (`./dev bench wasm`):
//     node wasm_bench.mjs FOLDER_OF_LISSOM_WASM PROGRAM FOLDER_OF_PLAYGROUND [--json]
// Times are those of speed.lua in node over those of the program on one thread, in turns; sizes are by brotli.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import zlib from 'node:zlib';
import { openBrowser, serve } from '../../web/browser.mjs';
import { openLibrary } from '../../web/library.mjs';

const [library, program, playground, ...options] = process.argv.slice(2);
if (!playground) {
    console.error('Usage: node wasm_bench.mjs FOLDER_OF_LISSOM_WASM PROGRAM FOLDER_OF_PLAYGROUND [--json]');
    process.exit(2);
}
const script = path.join(path.dirname(fileURLToPath(import.meta.url)), 'speed.lua');
const turns = 3, visits = 3;
const rows = [], isJson = options.includes('--json');

// The value at a share of a sorted list.
const quantile = (values, share) => [...values].sort((a, b) => a - b)[Math.floor(share * values.length)];

function add(row) {
    rows.push({ peer: null, ratio: null, low: null, high: null, target: null, better: 'less', ...row });
    if (isJson) return;
    const { name, value, unit, low, high, target } = rows[rows.length - 1];
    const range = low === null ? '' : ` (${low.toPrecision(3)} .. ${high.toPrecision(3)})`;
    const verdict = target === null ? '' : ` target <= ${target}: ${value <= target ? 'reached' : 'MISSED'}`;
    console.log(`  ${name.padEnd(58)} ${String(+value.toPrecision(4)).padStart(10)} ${unit.padEnd(8)}${range}${verdict}`);
}

// ---- What a page loads before its first picture: the files that a visit asks for, the help for the editor apart

const brotli = file => zlib.brotliCompressSync(file,
    { params: { [zlib.constants.BROTLI_PARAM_LGWIN]: 24, [zlib.constants.BROTLI_PARAM_SIZE_HINT]: file.length } }).length;
const sizeOf = names => names.reduce((sum, name) => sum + brotli(fs.readFileSync(path.join(playground, name))), 0) / 1e6;

function addSizes(names) {
    const later = names.filter(name => name === 'reference.json'), first = names.filter(name => !later.includes(name));
    add({ name: 'a page up to its first picture, by brotli', value: sizeOf(first), unit: 'MB', target: 1.6 });
    add({ name: 'of it lissom.wasm', value: sizeOf(['lissom.wasm']), unit: 'MB' });
    add({ name: 'of it the picture', value: sizeOf(names.filter(name => name === 'app.js')), unit: 'MB' });
    if (later.length) add({ name: 'completion and help, loaded afterwards', value: sizeOf(later), unit: 'MB' });
}

// ---- A first visit

async function visit(browser, address) {
    const context = await browser.createBrowserContext(), page = await context.newPage(), names = new Set();
    page.on('request', request => {
        if (request.url().startsWith(address)) names.add(new URL(request.url()).pathname.slice(1) || 'index.html');
    });
    await page.goto(address);
    await page.waitForFunction(() => window.lissomRuns > 0, { timeout: 240000 });
    const at = await page.evaluate(() => window.lissomLast.at);
    await context.close();
    return { seconds: at / 1000, names: [...names] };
}

async function addVisits() {
    const browser = await openBrowser(), { server, address } = await serve(playground), seen = [];
    for (let i = 0; i < visits; ++i) seen.push(await visit(browser, address));
    await browser.close();
    server.close();
    addSizes([...new Set(seen.flatMap(one => one.names))].filter(name => fs.existsSync(path.join(playground, name))));
    add({ name: 'first picture after the request, Chromium', value: quantile(seen.map(one => one.seconds), 0.5), unit: 's', target: 2 });
}

// ---- Speed beside the program

// Lines of names and seconds.
const secondsOf = text => Object.fromEntries(text.trim().split('\n').map(line => line.split('\t')).map(([name, value]) => [name, +value]));
const texts = { prepare: ['preparation of 43,000 vertices', 2.5], frame: ['frame of 43,000 vertices', 1.5], hair_first: ['20,000 strands, first', 2.5],
    hair_again: ['20,000 strands after a change of a stream', 2.5], merge: ['merging of 8,000 and 8,000 vertices', null] };

// The clock of a script is Date.now here: seconds of a processor, as the program's are, with those of the compiler.
function countProcessorTime() {
    Date.now = () => {
        const { user, system } = process.cpuUsage();
        return (user + system) / 1000;
    };
}

async function addSpeeds() {
    countProcessorTime();
    const page = await openLibrary(library), wasm = [], native = [];
    for (let turn = 0; turn < turns; ++turn) {
        page.log.length = 0;
        page.run(fs.readFileSync(script, 'utf8'));
        wasm.push(secondsOf(page.log.map(text => text.replace(/\n?$/, '\n')).join('')));
        native.push(secondsOf(execFileSync(program, ['run', '--threads', '1', script], { encoding: 'utf8' })));
    }
    for (const [key, [name, target]] of Object.entries(texts)) {
        const ratios = wasm.map((one, turn) => one[key] / native[turn][key]), value = quantile(ratios, 0.5);
        add({ name: `${name}: time`, value: 1000 * quantile(wasm.map(one => one[key]), 0.5), unit: 'ms' });
        add({ name: `${name}: over the program's`, peer: 'the program on one thread', value, ratio: value, unit: 'x',
            low: quantile(ratios, 0.25), high: quantile(ratios, 0.75), target });
    }
}

await addVisits();
await addSpeeds();
if (isJson) console.log(JSON.stringify(rows, null, 1));
process.exit(0);
