// Pictures of the page beside those of the program, by the comparison of expect.picture:
//     node pictures_test.mjs FOLDER_OF_PLAYGROUND LISSOM [--all] [--only NAME] [--pictures FOLDER]
// Ten scripts, with --all those of the whole gallery that draw surfaces. Ends with 77, as a test that is left out, if the page was
// not built, or there is no Chromium.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { toLink } from '../../viewer/web/link.js';
import { openBrowser, serve, skip } from './browser.mjs';

const here = path.dirname(fileURLToPath(import.meta.url)), root = path.join(here, '..', '..');
const [folder, program, ...options] = process.argv.slice(2);
if (!fs.existsSync(path.join(folder, 'lissom.wasm'))) skip('the playground was not built (./dev playground)');
const option = name => (options.includes(name) ? options[options.indexOf(name) + 1] : null);
const size = { width: 640, height: 480 };

// A pixel differs beyond the tolerance from all around it in the other picture; edges may. Hair is left out: where the
// program makes strands that are thinner than pixels transparent, the page leaves fragments of them out at random.
const limits = { tolerance: 0.06, pixels: 0.004, connected: 30 };
const ten = [
    { file: 'viewer/web/examples/bend.lua' },
    { file: 'viewer/web/examples/twist.lua' },
    { file: 'viewer/web/examples/join.lua' },
    { file: 'examples/deform/volume.lua' },
    { file: 'examples/deform/coarse_borders.lua' },
    { file: 'examples/deform/figure_2_9.lua' },
    { file: 'examples/deform/refine.lua' },
    { file: 'examples/merge/sphinx.lua', picture: 'sphinx' },
    { file: 'examples/merge/figure_3_4.lua', picture: 'figure_3_4' },
    { file: 'examples/merge/figure_3_7.lua', picture: 'figure_3_7' },
];

function gallery() {
    const rows = JSON.parse(fs.readFileSync(path.join(root, 'viewer/web/site/gallery.json'), 'utf8'));
    return rows.filter(one => !one.saved && !one.group.includes('airstyle') && !one.file.endsWith('groom.lua'));
}

const nameOf = one => one.picture || path.basename(one.file, '.lua');
const all = options.includes('--all') ? gallery() : ten;
const chosen = all.filter(one => !option('--only') || `${one.file} ${nameOf(one)}`.includes(option('--only')));

function drawNatively(one, file) {
    const values = Object.entries(one.values || {}).flatMap(([name, value]) => [`--${name}`, String(value)]);
    const work = fs.mkdtempSync(path.join(os.tmpdir(), 'lissom-pictures-'));
    try {
        execFileSync(program, ['run', path.join(here, 'native_picture.lua'), ...values], { cwd: work, stdio: ['ignore', 'ignore', 'pipe'], maxBuffer: 1 << 26, env: { ...process.env,
            WEB_SCRIPT: path.join(root, one.file), WEB_PICTURE: file, WEB_SIZE: `${size.width}x${size.height}`, ...(one.picture ? { WEB_NAME: one.picture } : {}) } });
    } finally {
        fs.rmSync(work, { recursive: true, force: true });
    }
}

const browser = await openBrowser(), { server, address } = await serve(folder);

// The picture of a script in the page, in the pixels of a screen: half of those that are drawn.
async function drawInPage(one, file) {
    const page = await (await browser.createBrowserContext()).newPage(), troubles = [];
    page.on('console', message => { if (['error', 'warn'].includes(message.type()) && !/GPU stall|GL Driver Message/.test(message.text())) troubles.push(message.text()); });
    page.on('pageerror', error => troubles.push(String(error)));
    await page.setViewport({ ...size, deviceScaleFactor: 2 });
    const script = fs.readFileSync(path.join(root, one.file), 'utf8');
    await page.goto(`${address}?embed#s=${await toLink({ script, values: one.values || {}, name: path.basename(one.file), picture: one.picture })}`);
    await page.waitForFunction(() => window.lissomRuns > 0, { timeout: 240000 });
    assert.equal((await page.evaluate(() => window.lissomLast)).error, undefined);
    const text = await page.evaluate(async ({ width, height }) => {
        const view = window.lissomView;
        Object.assign(view.canvas.style, { position: 'fixed', left: '0', top: '0', width: `${width}px`, height: `${height}px` });
        view.covered = () => ({ left: 0, right: 0, bottom: 0 });
        await new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve)));
        view.frame();
        const [drawn, flat] = [await createImageBitmap(await view.png('#ffffff')), document.createElement('canvas')];
        Object.assign(flat, { width, height });
        const context = flat.getContext('2d');
        context.imageSmoothingQuality = 'high';
        context.drawImage(drawn, 0, 0, width, height);
        return flat.toDataURL('image/png').split(',')[1];
    }, size);
    fs.writeFileSync(file, Buffer.from(text, 'base64'));
    await page.close();
    assert.deepEqual(troubles, []);
}

const out = path.resolve(option('--pictures') || fs.mkdtempSync(path.join(os.tmpdir(), 'lissom-pictures-')));
fs.mkdirSync(out, { recursive: true });
const quoted = JSON.stringify, rows = [], failures = [];
for (const [i, one] of chosen.entries()) {
    const name = `${i + 1}_${nameOf(one)}`, [page, native] = ['page', 'native'].map(host => path.join(out, `${name}_${host}.png`));
    try {
        drawNatively(one, native);
        await drawInPage(one, page);
        const options = Object.entries(limits).map(([key, value]) => `${key} = ${value}`).join(', ');
        rows.push(`test(${quoted(name)}, function() expect.picture(${quoted(page)}, ${quoted(native)}, { ${options} }) end)`);
    } catch (error) {
        failures.push(`${name}: ${error.stderr?.toString().slice(-600) || ''}${error.stack}`);
    }
}
await browser.close();
server.close();
// The comparison is that of `lissom test`.
const list = path.join(out, 'pictures_test.lua');
fs.writeFileSync(list, `${rows.join('\n')}\n`);
const compared = spawnSync(program, ['test', '--verbose', list], { encoding: 'utf8', env: { ...process.env, LISSOM_REQUIRE_GL: '1' } });
console.log(compared.stdout + compared.stderr + failures.join('\n'));
if (!option('--pictures') && compared.status === 0 && failures.length === 0) fs.rmSync(out, { recursive: true, force: true });
process.exit(compared.status === 0 && failures.length === 0 ? 0 : 1);
