// The playground in Chromium, by a hand; in Firefox with LISSOM_BROWSER=firefox and a display:
//     node playground_test.mjs FOLDER_OF_PLAYGROUND [--all] [--only NAME] [--pictures FOLDER]
// Any error of the page's console fails. With --all every example runs. Ends with 77, as a test that is left out, if the
// page was not built, or there is no such browser or no puppeteer-core.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { openBrowser, serve, skip } from './browser.mjs';

const [folder, ...options] = process.argv.slice(2);
if (!fs.existsSync(path.join(folder, 'lissom.wasm'))) skip('the playground was not built (./dev playground)');
const browser = await openBrowser(), { server, address } = await serve(folder);
const pictures = options.includes('--pictures') ? options[options.indexOf('--pictures') + 1] : null;
const troubles = [];
const patience = 240000;

async function opened(hash = '', size = { width: 1400, height: 900 }) {
    const context = await browser.createBrowserContext(), page = await context.newPage();
    await page.setViewport(size);
    page.on('console', message => { if (['error', 'warn'].includes(message.type()) && !/GPU stall|GL Driver Message/.test(message.text())) troubles.push(message.text()); });
    page.on('pageerror', error => troubles.push(String(error)));
    // Nothing comes from elsewhere.
    page.on('request', request => { if (!/^(data|blob):/.test(request.url()) && !request.url().startsWith(address)) troubles.push(`elsewhere: ${request.url()}`); });
    page.on('requestfailed', request => troubles.push(`${request.url()}: ${request.failure()?.errorText}`));
    await page.goto(address + hash);
    await runs(page, 1);
    return page;
}
const runs = (page, count) => page.waitForFunction(count => (window.lissomRuns || 0) >= count, { timeout: patience }, count);
const count = page => page.evaluate(() => window.lissomRuns);
const last = page => page.evaluate(() => window.lissomLast);
const shot = async (page, name) => {
    if (!pictures) return;
    await new Promise(resolve => setTimeout(resolve, 800));
    fs.mkdirSync(pictures, { recursive: true });
    await page.screenshot({ path: path.join(pictures, `${name}.png`) });
};
// The mean difference of two views of the canvas, 0 to 255.
const seen = page => page.evaluate(() => {
    const view = window.lissomView, gl = view.gl;
    view.draw();
    const bytes = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    window.before = window.now;
    window.now = bytes;
    let covered = 0;
    for (let i = 3; i < bytes.length; i += 4) covered += bytes[i] > 0;
    let changed = 0;
    if (window.before?.length === bytes.length) for (let i = 0; i < bytes.length; ++i) changed += Math.abs(bytes[i] - window.before[i]);
    return { covered: 4 * covered / bytes.length, changed: changed / bytes.length };
});

const cases = [];
const test = (name, check) => cases.push({ name, check });

test('the first visit shows a bent cactus', async () => {
    const page = await opened();
    assert.deepEqual((await last(page)).error, undefined);
    const { covered } = await seen(page);
    assert.ok(covered > 0.04 && covered < 0.7, `covered ${covered}`);
    const { at, whole, ms } = await last(page);
    console.log(`        first picture ${Math.round(at)} ms after the request; run ${Math.round(ms)} ms, with the start of the library ${Math.round(whole)} ms`);
    await shot(page, 'desktop');
    await page.close();
});

test('a hand turns the view, and a slider bends the shape', async () => {
    const page = await opened();
    await seen(page);
    const box = await (await page.$('#canvas')).boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 160, y + 40, { steps: 5 });
    await page.mouse.up();
    assert.ok((await seen(page)).changed > 0.5);
    const before = await count(page);
    await page.evaluate(() => {
        const range = document.querySelector('#parameters input[type=range]');
        range.value = -90;
        range.dispatchEvent(new Event('input'));
    });
    await runs(page, before + 1);
    assert.equal((await last(page)).ok, true);
    assert.ok((await seen(page)).changed > 0.5);
    await page.close();
});

test('an edited line runs by itself; an error jumps to its line; the mended script runs', async () => {
    const page = await opened();
    let before = await count(page);
    await page.evaluate(() => { window.lissomEditor.text = 'local lissom = require "lissom"\n'; });
    await page.click('#editor .cm-content');
    await page.keyboard.down('Control');
    await page.keyboard.press('End');
    await page.keyboard.up('Control');
    await page.keyboard.type('return lissom.shapes.box{ widht = 2');
    await page.keyboard.press('Escape');
    await runs(page, before + 1);
    assert.match((await last(page)).error.message, /:2:.*widht/s);
    assert.ok(await page.$('#editor .failed-line'));
    await shot(page, 'error');
    await page.click('#console .error button');
    assert.equal(await page.evaluate(() => { const { state } = window.lissomEditor.view; return state.doc.lineAt(state.selection.main.head).number; }), 2);
    before = await count(page);
    await page.evaluate(() => { window.lissomEditor.text = 'return require("lissom").shapes.torus()'; });
    await page.click('#run');
    await runs(page, before + 1);
    assert.equal((await last(page)).ok, true);
    await page.close();
});

test('names are completed, and explained', async () => {
    const page = await opened();
    await page.waitForFunction(() => performance.getEntriesByType('resource').some(one => one.name.endsWith('reference.json')));
    await page.evaluate(() => { window.lissomEditor.text = ''; });
    await page.click('#editor .cm-content');
    await page.keyboard.type('local m = lissom.shapes.cac', { delay: 30 });
    await page.waitForSelector('.cm-tooltip-autocomplete', { timeout: 20000 });
    assert.match(await page.$eval('.cm-tooltip-autocomplete', node => node.textContent), /cactus/);
    await shot(page, 'completion');
    await page.close();
});

test('a link holds the script and its values', async () => {
    const page = await opened();
    const before = await count(page);
    await page.evaluate(() => {
        const range = document.querySelector('#parameters input[type=range]');
        range.value = 15;
        range.dispatchEvent(new Event('input'));
    });
    await runs(page, before + 1);
    await page.click('#share');
    await page.waitForFunction(() => window.lissomLink);
    const link = await page.evaluate(() => window.lissomLink), text = await page.evaluate(() => window.lissomEditor.text);
    const other = await opened(new URL(link).hash);
    assert.equal(await other.evaluate(() => window.lissomEditor.text), text);
    assert.equal(await other.evaluate(() => document.querySelector('#parameters input[type=range]').value), '15');
    const broken = await opened(new URL(link).hash.slice(0, 60));
    assert.match(await broken.$eval('#note', node => node.textContent), /not whole/);
    assert.equal((await last(broken)).ok, true);
    await Promise.all([page, other, broken].map(one => one.close()));
});

test('a script without an end is stopped, one that floods the console is cut, and the next one runs', async () => {
    const page = await opened();
    await page.evaluate(() => { window.lissomEditor.text = 'while true do end'; });
    await page.click('#run');
    await page.waitForFunction(() => !document.getElementById('busy').hidden);
    const start = Date.now();
    await page.click('#stop');
    await page.waitForFunction(() => document.getElementById('busy').hidden);
    assert.ok(Date.now() - start < 1500);
    const before = await count(page);
    await page.evaluate(() => { window.lissomEditor.text = 'for i = 1, 20000 do print(i) end return require("lissom").shapes.box()'; });
    await page.click('#run');
    await runs(page, before + 1);
    assert.equal((await last(page)).ok, true);
    assert.match(await page.$eval('#console', node => node.textContent), /left out/);
    await page.close();
});

test('two hundred runs take no more memory than twenty', async () => {
    const page = await opened(), memory = {};
    // Meshes, a deformation, hair and an error: each run leaves what it made to the next one's collector.
    await page.evaluate(() => { window.lissomEditor.text = `local lissom = require "lissom"
local p = lissom.params{ angle = { type = "number", default = 30, min = -90, max = 90 } }
local bar = lissom.shapes.bar{ across = 6, along = 24 }
local deformer = lissom.deformer(bar)
deformer:pin(bar:region("bottom"))
deformer:add_handle(bar:region("top")):rotate{ axis = "z", angle = p.angle }
deformer:solve()
if p.angle > 80 then error("too far") end
return bar`; });
    let before = await count(page);
    await page.click('#run');
    await runs(page, before + 1);
    for (let i = 1; i <= 200; ++i) {
        before = await count(page);
        await page.evaluate(i => {
            const range = document.querySelector('#parameters input[type=range]');
            range.value = i % 10 ? i % 80 : 85;
            range.dispatchEvent(new Event('input'));
        }, i);
        await runs(page, before + 1);
        assert.equal((await last(page)).ok, i % 10 > 0);
        memory[i] = (await last(page)).memory;
    }
    console.log(`        ${[20, 100, 200].map(i => `${(memory[i] / 1e6).toFixed(1)} MB after ${i}`).join(', ')}`);
    assert.equal(memory[200], memory[20]);
    await page.close();
});

test('a dropped mesh is shown, and downloads are given', async () => {
    const page = await opened();
    const before = await count(page);
    await page.evaluate(() => {
        const files = new DataTransfer();
        files.items.add(new File(['v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n'], 'four faces.obj'));
        window.dispatchEvent(new DragEvent('drop', { dataTransfer: files, cancelable: true }));
    });
    await runs(page, before + 1);
    assert.equal((await last(page)).ok, true);
    assert.match(await page.$eval('#counts', node => node.textContent), /^4 vertices/);
    for (const name of ['.obj', '.glb', '.png']) {
        await page.evaluate(() => { window.lissomGiven = null; });
        await page.click('#download');
        await page.evaluate(name => [...document.querySelectorAll('#downloads button')].find(one => one.textContent.startsWith(name)).click(), name);
        await page.waitForFunction(name => window.lissomGiven?.endsWith(name), { timeout: 20000 }, name);
    }
    await page.close();
});

test('without a network the page opens again', async () => {
    const page = await opened();
    await page.evaluate(() => navigator.serviceWorker.ready);
    await page.reload();
    await runs(page, 1);
    await page.setOfflineMode(true);
    await page.reload();
    await runs(page, 1);
    assert.equal((await last(page)).ok, true);
    await page.setOfflineMode(false);
    await page.close();
});

test('on a phone the picture, the values and the script have panes', async () => {
    const page = await opened('', { width: 390, height: 844, deviceScaleFactor: 2, hasTouch: true, isMobile: true });
    assert.ok((await seen(page)).covered > 0.03);
    await shot(page, 'phone');
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), true);
    await page.tap('nav [data-show=parameters]');
    await shot(page, 'phone_values');
    assert.equal(await page.$eval('#parameters', node => node.getBoundingClientRect().height > 100), true);
    await page.tap('nav [data-show=script]');
    await shot(page, 'phone_script');
    assert.equal(await page.$eval('#editor', node => node.getBoundingClientRect().height > 200), true);
    await page.close();
});

test('examples run', async () => {
    const examples = JSON.parse(fs.readFileSync(path.join(folder, 'examples.json'), 'utf8'));
    for (const { name } of options.includes('--all') ? examples : examples.slice(0, 4)) {
        const page = await opened(`#${name}`);
        const { ok, ms, memory, error } = await last(page);
        assert.equal(ok, true, `${name}: ${error?.message}`);
        assert.ok((await seen(page)).covered > 0.02, name);
        console.log(`        ${name.padEnd(14)} ${(ms / 1000).toFixed(2).padStart(6)} s ${Math.round(memory / 1e6).toString().padStart(6)} MB`);
        await shot(page, `example_${name}`);
        await page.close();
    }
});

const only = options.includes('--only') ? options[options.indexOf('--only') + 1] : '';
let failed = 0, done = 0;
for (const { name, check } of cases.filter(one => one.name.includes(only))) {
    troubles.length = 0;
    ++done;
    try {
        await check();
        assert.deepEqual(troubles, []);
        console.log(`ok      ${name}`);
    } catch (error) {
        ++failed;
        console.log(`FAILED  ${name}\n${error.stack}\n${troubles.join('\n')}`);
    }
}
await browser.close();
server.close();
console.log(`${done - failed} of ${done} passed`);
process.exit(failed ? 1 : 0);
