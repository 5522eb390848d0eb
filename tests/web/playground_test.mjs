// The playground in Chromium, by a hand; in Firefox with LISSOM_BROWSER=firefox and a display:
//     node playground_test.mjs FOLDER_OF_PLAYGROUND [--all | --few] [--only NAME] [--pictures FOLDER]
// Any error of the page's console fails. With --all every example runs, with --few the ten tests that CI has time for. Ends with 77, as a test that is left out, if the
// page was not built, or there is no such browser or no puppeteer-core.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { toLink } from '../../viewer/web/link.js';
import { openBrowser, serve, skip } from './browser.mjs';

const [folder, ...options] = process.argv.slice(2);
if (!fs.existsSync(path.join(folder, 'lissom.wasm'))) skip('the playground was not built (./dev playground)');
const browser = await openBrowser(), { server, address } = await serve(folder);
const pictures = options.includes('--pictures') ? options[options.indexOf('--pictures') + 1] : null;
const troubles = [];
const patience = 240000;

// `before`: a function that the page runs first.
async function opened(hash = '', size = { width: 1400, height: 900 }, before = null) {
    const context = await browser.createBrowserContext(), page = await context.newPage();
    if (before) await page.evaluateOnNewDocument(before);
    await page.setViewport(size);
    page.on('console', message => { if (['error', 'warn'].includes(message.type()) && !/GPU stall|GL Driver Message/.test(message.text())) troubles.push(message.text()); });
    page.on('pageerror', error => troubles.push(String(error)));
    // Nothing comes from elsewhere.
    page.on('request', request => { if (!/^(data|blob):/.test(request.url()) && !request.url().startsWith(address)) troubles.push(`elsewhere: ${request.url()}`); });
    page.on('requestfailed', request => troubles.push(`${request.url()}: ${request.failure()?.errorText}`));
    await page.goto(address + hash);
    await runs(page, 1);
    // Failures of all that the hand did, until they are looked at.
    await page.evaluate(() => {
        const hand = window.lissomHand, answered = hand?.answered;
        if (hand) hand.answered = () => { (hand.failures ??= []).push(...[].concat(hand.last.failures)); answered.call(hand); };
    });
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

// ---- A hand with a tool

const handIn = async (page, script, frame = {}) => {
    const before = await count(page);
    await page.evaluate(script => { window.lissomEditor.text = script; }, script);
    await page.click('#run');
    await runs(page, before + 1);
    assert.equal((await last(page)).ok, true);
    await page.evaluate(({ toward }) => {
        const view = window.lissomView;
        view.frame();
        if (toward) view.toward = toward;
        view.fit();
    }, frame);
};
// What the worker has answered when it has done all.
const answered = async page => {
    await new Promise(resolve => setTimeout(resolve, 120));
    for (let again = 0; again < 2; ++again) {
        await page.waitForFunction(() => !window.lissomHand.isWaiting && !window.lissomHand.queue.length && !window.lissomHand.finger, { timeout: patience });
        await page.evaluate(() => new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve))));
    }
    return page.evaluate(() => {
        const hand = window.lissomHand, failures = hand.failures || [];
        hand.failures = [];
        const { steps, tool, keys, marks, memory } = hand.last;
        return { steps, failures, tool, keys, marks, memory };
    });
};
const take = async (page, tool) => {
    await page.click(`[data-tool="${tool}"]`);
    return answered(page);
};
// The pixel of a point of the world in the page.
const pixel = (page, point) => page.evaluate(point => {
    const box = window.lissomView.canvas.getBoundingClientRect(), [x, y] = window.lissomView.project(...point);
    return [box.left + x, box.top + y];
}, point);
// The corner of the first mesh that lies farthest along a direction, of those in a box.
const farthest = (page, along, low = [-9, -9, -9], high = [9, 9, 9], mesh = 0) => page.evaluate((along, low, high, mesh) => {
    const places = window.lissomView.picture.meshes[mesh].positions;
    let best = -Infinity, found = null;
    for (let i = 0; i < places.length; i += 3) {
        const point = [places[i], places[i + 1], places[i + 2]];
        if (point.some((x, k) => x < low[k] || x > high[k])) continue;
        const reach = point.reduce((sum, x, k) => sum + x * along[k], 0);
        if (reach > best) { best = reach; found = point; }
    }
    return found;
}, along, low, high, mesh);
const between = (a, b, n) => Array.from({ length: n }, (_, i) => a.map((x, k) => x + (b[k] - x) * (i + 1) / n));
const stroke = async (page, pixels, steps = 6) => {
    await page.mouse.move(...pixels[0]);
    await page.mouse.down();
    for (let i = 1; i < pixels.length; ++i) for (const at of between(pixels[i - 1], pixels[i], steps)) await page.mouse.move(...at);
    await page.mouse.up();
    return answered(page);
};
const press = async (page, key, held = []) => {
    for (const one of held) await page.keyboard.down(one);
    await page.keyboard.press(key);
    for (const one of held) await page.keyboard.up(one);
    return answered(page);
};
// The end of the gizmo's arrow along x.
const arrowEnd = (page, marks) => {
    const { points } = marks.lines.find(({ points }) => points.length === 6 && points[3] > points[0] && points[4] === points[1]);
    return pixel(page, points.slice(3));
};
const bar = 'return require("lissom").shapes.bar{ length = 4, width = 1, across = 8, along = 32 }';

// A bar pinned at its lower end, with a handle at the other: `paint` draws a stroke over the surface.
const preparedBar = async (page, paint) => {
    await paint([-0.3, -1.8, 0.5], [0.3, -1.8, 0.5]);
    await press(page, 'p');
    await paint([-0.3, 1.8, 0.5], [0.3, 1.8, 0.5]);
    return press(page, 'Enter');
};

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

test('with the tool deform a hand bends a bar; undo brings it back to the bit, redo bends it again', async () => {
    const page = await opened();
    await handIn(page, bar, { toward: [0, 0, 1] });
    const first = await take(page, 'deform');
    assert.equal(first.tool, 'deform');
    const paint = async (a, b) => stroke(page, [await pixel(page, a), await pixel(page, b)]);
    const before = await preparedBar(page, paint);
    assert.deepEqual(before.failures, []);
    const tip = await arrowEnd(page, before.marks), side = () => page.evaluate(() => window.lissomView.picture.meshes[0].box.high[0]), shape = await side();
    const after = await stroke(page, [tip, [tip[0] - 40, tip[1]], [tip[0] + 90, tip[1]]]);
    assert.notEqual(after.keys[0], before.keys[0]);
    assert.ok(await side() > shape + 0.2);
    await shot(page, 'hand_deform');
    assert.equal((await press(page, 'z', ['Control'])).keys[0], before.keys[0]);
    assert.equal((await press(page, 'y', ['Control'])).keys[0], after.keys[0]);
    await page.click('#undo');
    assert.equal((await answered(page)).keys[0], before.keys[0]);
    for (let i = 0; i < before.steps.count; ++i) await page.click('#undo');
    assert.equal((await answered(page)).keys[0], first.keys[0]);
    assert.equal(await page.$eval('#undo', button => button.disabled), true);
    // What was done by hand is the mesh that is downloaded.
    await press(page, 'y', ['Control']);
    await page.click('#download');
    await page.evaluate(() => [...document.querySelectorAll('#downloads button')].find(one => one.textContent.startsWith('.obj')).click());
    await page.waitForFunction(() => window.lissomGiven?.endsWith('.obj'));
    await page.close();
});

test('an error of a tool is told, and keys are the hand\'s after a click on a button', async () => {
    const page = await opened();
    await handIn(page, bar, { toward: [0, 0, 1] });
    await take(page, 'select');
    await stroke(page, [await pixel(page, [0, 0, 0.5]), await pixel(page, [0.2, 0, 0.5])]);
    const some = (await answered(page)).keys[0];
    await page.evaluate(() => [...document.querySelectorAll('#keys button')].find(one => one.textContent === 'Grow').focus());
    await page.click('#keys button:last-child');
    assert.notEqual((await answered(page)).keys[0], some);
    assert.notEqual((await press(page, 'i')).keys[0], some);
    // No tool makes this error: a value that the select tool lacks.
    const before = (await answered(page)).keys[0];
    await page.evaluate(() => window.lissomHand.put({ kind: 'set', name: 'raduis', value: 3 }));
    const refused = await answered(page);
    assert.match(refused.failures[0].message, /raduis/);
    assert.equal(refused.keys[0], before);
    assert.match(await page.$eval('#console .error', node => node.textContent), /raduis/);
    await page.close();
});

test('a brush smooths the surface', async () => {
    const page = await opened();
    await handIn(page, bar, { toward: [0.5, 0.2, 0.84] });
    const before = await take(page, 'smooth'), edge = await farthest(page, [1, 0, 1], [-9, -0.1, -9], [9, 0.1, 9]);
    const after = await stroke(page, [await pixel(page, edge), await pixel(page, [edge[0], edge[1] + 0.3, edge[2]])]);
    assert.notEqual(after.keys[0], before.keys[0]);
    assert.equal(after.steps.undo, 'smooth');
    assert.equal((await press(page, 'z', ['Control'])).keys[0], before.keys[0]);
    await page.close();
});

test('a frame in another page has no tools, and its picture is the same', async () => {
    const page = await browser.newPage();
    page.on('pageerror', error => troubles.push(String(error)));
    await page.goto(`${address}?embed#bend`);
    await runs(page, 1);
    assert.equal((await last(page)).ok, true);
    assert.equal(await page.$eval('#toolbar', bar => bar.getBoundingClientRect().width), 0);
    await page.close();
});

test('undo and redo go by the letter of the layout', async () => {
    const page = await opened();
    await handIn(page, bar, { toward: [0, 0, 1] });
    const before = await take(page, 'select'), after = await stroke(page, [await pixel(page, [0, 0, 0.5]), await pixel(page, [0.2, 0, 0.5])]);
    assert.notEqual(after.keys[0], before.keys[0]);
    const typed = async (key, code, shiftKey = false) => {
        await page.evaluate((key, code, shiftKey) => document.getElementById('canvas').dispatchEvent(new KeyboardEvent('keydown', { key, code, shiftKey, ctrlKey: true, bubbles: true, cancelable: true })), key, code, shiftKey);
        return (await answered(page)).keys[0];
    };
    // A German Z lies where others have Y; on a Russian board the key of Z counts.
    assert.equal(await typed('z', 'KeyY'), before.keys[0]);
    assert.equal(await typed('y', 'KeyZ'), after.keys[0]);
    assert.equal(await typed('я', 'KeyZ'), before.keys[0]);
    assert.equal(await typed('Z', 'KeyZ', true), after.keys[0]);
    // The editor keeps its own.
    await page.click('#editor .cm-content');
    await press(page, 'z', ['Control']);
    assert.equal((await answered(page)).keys[0], after.keys[0]);
    await page.close();
});

test('a tool sees every motion of the hand, also those that a slow one has to wait for', async () => {
    const page = await opened();
    await handIn(page, bar, { toward: [0, 0, 1] });
    await take(page, 'select');
    const at = await pixel(page, [0, -1, 0.5]);
    const seen = await page.evaluate(async ([x, y]) => {
        const canvas = document.getElementById('canvas'), { post } = window.lissomHand, moves = [];
        window.lissomHand.post = message => { moves.push(...message.inputs.filter(one => one.kind === 'move')); post(message); };
        const event = (type, i, more = {}) => new PointerEvent(type, { pointerId: 1, pointerType: 'pen', pressure: 0.5, clientX: x + 0.2 * i, clientY: y - i, button: 0, buttons: 1, bubbles: true, ...more });
        canvas.dispatchEvent(event('pointerdown', 0));
        for (let i = 1; i <= 60; ++i) {
            const move = event('pointermove', 2 * i);
            move.getCoalescedEvents = () => [event('pointermove', 2 * i - 1), event('pointermove', 2 * i)];
            canvas.dispatchEvent(move);
        }
        canvas.dispatchEvent(event('pointerup', 120, { buttons: 0 }));
        while (window.lissomHand.isWaiting || window.lissomHand.queue.length) await new Promise(resolve => setTimeout(resolve, 20));
        return moves.map(one => one.event.y - moves[0].event.y);
    }, at);
    assert.deepEqual(seen.map(Math.round), Array.from({ length: 120 }, (_, i) => 0 - i));
    await page.close();
});

test('a pen smooths as hard as it presses', async () => {
    const page = await opened();
    await handIn(page, bar, { toward: [0, 0, 1] });
    const { keys: [flat] } = await take(page, 'smooth');
    // An edge, which smoothing rounds off.
    const at = await pixel(page, [0.48, 0, 0.5]), keys = [];
    for (const [pointerType, pressure] of [['mouse', 0.5], ['pen', 1], ['pen', 0.25]]) {
        await page.evaluate(([x, y], pointerType, pressure) => {
            const canvas = document.getElementById('canvas');
            const event = (type, more) => canvas.dispatchEvent(new PointerEvent(type,
                { pointerId: 1, pointerType, pressure, clientX: x, clientY: y, button: 0, buttons: 1, bubbles: true, ...more }));
            event('pointerdown');
            event('pointerup', { buttons: 0, pressure: 0 });
        }, at, pointerType, pressure);
        const { failures, keys: [key] } = await answered(page);
        assert.deepEqual(failures, []);
        keys.push(key);
        await press(page, 'z', ['Control']);
    }
    // A mouse presses fully, though browsers tell a half.
    assert.equal(keys[0], keys[1]);
    assert.notEqual(keys[1], keys[2]);
    assert.ok(!keys.includes(flat));
    await page.close();
});

test('streams, a parting and a tail are drawn on a head, and its hair follows', async () => {
    const page = await opened();
    await handIn(page, 'return require("lissom").shapes.head{ vertices = 6000 }', { toward: [0.35, 0.35, 0.87] });
    const head = await take(page, 'stream');
    assert.equal(head.keys.length, 1);
    // Strokes from the top of the head down, to both sides.
    const top = await farthest(page, [0, 1, 0]), crown = await pixel(page, top);
    const side = sign => [[crown[0] + 30 * sign, crown[1] + 25], [crown[0] + 110 * sign, crown[1] + 90], [crown[0] + 130 * sign, crown[1] + 220]];
    const one = await stroke(page, side(-1)), two = await stroke(page, side(1));
    assert.deepEqual([one.failures, two.failures], [[], []]);
    assert.equal(one.keys.length, 2);
    assert.notEqual(one.keys[1], two.keys[1]);
    assert.equal(one.keys[0], head.keys[0]);
    assert.match(await page.$eval('#counts', node => node.textContent), /5,000 strands/);
    await shot(page, 'hand_stream');
    await take(page, 'comb');
    const combed = await stroke(page, [[crown[0] + 60, crown[1] + 60], [crown[0] + 100, crown[1] + 120], [crown[0] + 170, crown[1] + 190]]);
    assert.deepEqual(combed.failures, []);
    assert.notEqual(combed.keys[1], two.keys[1]);
    assert.equal((await press(page, 'z', ['Control'])).keys[1], two.keys[1]);
    await take(page, 'parting');
    const parted = await stroke(page, [[crown[0] + 8, crown[1] + 34], [crown[0] + 5, crown[1] + 8]]);
    assert.deepEqual(parted.failures, []);
    assert.notEqual(parted.keys[1], two.keys[1]);
    await shot(page, 'hand_parting');
    // From behind, on the right.
    await page.evaluate(() => { const view = window.lissomView; view.toward = [-0.94, 0.1, -0.33]; view.ask(); });
    await take(page, 'ponytail');
    const back = await pixel(page, await farthest(page, [0, 0.4, -1], [-9, 0, -9], [9, 9, 9])), away = Math.sign((await pixel(page, [0, 0, -1]))[0] - back[0]);
    const tail = await stroke(page, [[back[0] - 12 * away, back[1]], [back[0] + 60 * away, back[1] + 10], [back[0] + 100 * away, back[1] + 80], [back[0] + 105 * away, back[1] + 190]]);
    assert.deepEqual(tail.failures, []);
    assert.notEqual(tail.keys[1], parted.keys[1]);
    await shot(page, 'hand_ponytail');
    assert.equal((await press(page, 'z', ['Control'])).keys[1], parted.keys[1]);
    // A slider of the tool.
    const before = (await take(page, 'stream')).keys[1];
    await page.evaluate(() => {
        const range = document.querySelector('#parameters input[type=range][aria-label=length]');
        range.value = 0.1;
        range.dispatchEvent(new Event('input'));
    });
    const short = await answered(page);
    assert.notEqual(short.keys[1], before);
    console.log(`        ${Math.round(short.memory / 1e6)} MB`);
    await page.close();
});

test('a part is pasted onto another mesh, and what fails leaves all as before', async () => {
    const page = await opened();
    await handIn(page, `local lissom = require "lissom"
local ball = lissom.shapes.sphere{ segments = 24, kind = "triangles" }
local head = lissom.shapes.head{ vertices = 6000 }
head:transform{ scale = 6, translate = { 3, 0, 0 } }
return ball, head`, { toward: [0, 0, 1] });
    const empty = await take(page, 'paste');
    const over = await pixel(page, [0.1, 0.1, 0.98]);
    const refused = await stroke(page, [over, [over[0] + 5, over[1]]]);
    assert.match(refused.failures[0].message, /nothing is selected/);
    assert.match(await page.$eval('#console', node => node.textContent), /nothing is selected/);
    assert.deepEqual(refused.keys, empty.keys);
    await take(page, 'select');
    const nose = await pixel(page, await farthest(page, [0, 0, 1], [2.7, -1, -9], [3.3, 9, 9], 1));
    await stroke(page, [nose, [nose[0] + 4, nose[1] - 12], [nose[0], nose[1] - 16]]);
    await take(page, 'paste');
    await page.mouse.move(...over);
    await page.mouse.down();
    await page.mouse.move(over[0] + 6, over[1] - 4);
    await answered(page);
    await page.mouse.wheel({ deltaY: -200 });
    assert.equal((await answered(page)).keys.length, 3);
    await shot(page, 'hand_paste');
    await page.mouse.up();
    const pasted = await answered(page);
    assert.deepEqual(pasted.failures, []);
    assert.deepEqual([pasted.keys.length, pasted.steps.undo], [2, 'paste']);
    assert.ok(!pasted.keys.includes(empty.keys[0]));
    assert.ok((await press(page, 'z', ['Control'])).keys.includes(empty.keys[0]));
    await page.close();
});

test('a script that runs again begins anew, with the tool in hand and its values', async () => {
    const page = await opened();
    await handIn(page, bar, { toward: [0, 0, 1] });
    const first = await take(page, 'select');
    await page.evaluate(() => {
        const range = document.querySelector('#parameters input[type=range][aria-label=radius]');
        range.value = 60;
        range.dispatchEvent(new Event('input'));
    });
    const wide = await stroke(page, [await pixel(page, [0, 0, 0.5]), await pixel(page, [0.1, 0, 0.5])]);
    assert.notEqual(wide.keys[0], first.keys[0]);
    // A typed letter does not run the script while there is work of a hand.
    const before = await count(page);
    await page.click('#editor .cm-content');
    await page.keyboard.type(' ');
    await new Promise(resolve => setTimeout(resolve, 1300));
    assert.equal(await count(page), before);
    await page.click('#run');
    await runs(page, before + 1);
    const again = await answered(page);
    assert.deepEqual([again.keys, again.steps.count, again.tool], [first.keys, 0, 'select']);
    assert.equal(await page.$eval('#parameters input[type=range][aria-label=radius]', range => range.value), '60');
    assert.equal((await stroke(page, [await pixel(page, [0, 0, 0.5]), await pixel(page, [0.1, 0, 0.5])])).keys[0], wide.keys[0]);
    // Without a tool a drag turns the view, and the work stays.
    await take(page, '');
    const toward = await page.evaluate(() => window.lissomView.toward);
    await stroke(page, [await pixel(page, [0, 0, 0.5]), await pixel(page, [1, 0, 0.5])]);
    assert.notDeepEqual(await page.evaluate(() => window.lissomView.toward), toward);
    assert.equal((await answered(page)).keys[0], wide.keys[0]);
    await page.close();
});

test('one finger is the hand of a tool, two turn the view', async () => {
    const page = await opened('', { width: 390, height: 844, deviceScaleFactor: 2, hasTouch: true, isMobile: true });
    await page.evaluate(text => { window.lissomEditor.text = text; }, bar);
    const run = await count(page);
    await page.tap('#run');
    await runs(page, run + 1);
    await page.evaluate(() => { const view = window.lissomView; view.frame(); view.toward = [0, 0, 1]; view.fit(); });
    await page.tap('[data-tool=deform]');
    await answered(page);
    const drag = async pixels => {
        await page.touchscreen.touchStart(...pixels[0]);
        for (let i = 1; i < pixels.length; ++i) for (const at of between(pixels[i - 1], pixels[i], 6)) await page.touchscreen.touchMove(...at);
        await page.touchscreen.touchEnd();
        return answered(page);
    };
    const paint = async (a, b) => drag([await pixel(page, a), await pixel(page, b)]);
    const tap = async text => {
        await page.evaluate(text => [...document.querySelectorAll('#keys button')].find(one => one.textContent === text).click(), text);
        return answered(page);
    };
    await paint([-0.3, -1.8, 0.5], [0.3, -1.8, 0.5]);
    await tap('Pin');
    await paint([-0.3, 1.8, 0.5], [0.3, 1.8, 0.5]);
    const before = await tap('Handle');
    assert.deepEqual(before.failures, []);
    await shot(page, 'hand_phone_before');
    const tip = await arrowEnd(page, before.marks), after = await drag([tip, [tip[0] - 50, tip[1]]]);
    assert.notEqual(after.keys[0], before.keys[0]);
    await shot(page, 'hand_phone');
    // A second finger takes the first one from the tool, and what that has begun back.
    const view = () => page.evaluate(() => [...window.lissomView.toward, window.lissomView.distance]);
    const [middle, seen] = [await pixel(page, [0, 0, 0.5]), await view()];
    const one = await page.touchscreen.touchStart(middle[0] - 30, middle[1]), two = await page.touchscreen.touchStart(middle[0] + 30, middle[1]);
    for (let i = 1; i <= 6; ++i) {
        await one.move(middle[0] - 30 + 3 * i, middle[1] + 4 * i);
        await two.move(middle[0] + 30 + 9 * i, middle[1] + 4 * i);
    }
    await one.end();
    await two.end();
    const turned = await answered(page), now = await view();
    assert.deepEqual([turned.keys[0], turned.steps.count], [after.keys[0], after.steps.count]);
    assert.ok(now.every((x, k) => Math.abs(x - seen[k]) > 1e-3), `${seen} ${now}`);
    await page.tap('#undo');
    assert.equal((await answered(page)).keys[0], before.keys[0]);
    await page.close();
});

test('every tool of the bar can be taken', async () => {
    const page = await opened();
    await handIn(page, 'return require("lissom").shapes.head{ vertices = 3000 }');
    const names = await page.$$eval('#toolbar [data-tool]', buttons => buttons.map(one => one.dataset.tool).filter(Boolean));
    assert.ok(names.length >= 18, String(names));
    for (const name of names) {
        const { tool, failures } = await take(page, name);
        assert.deepEqual([tool, failures], [name, []]);
    }
    await shot(page, 'toolbar');
    await page.close();
});

test('a bar is cut, lined, bent by bones and put elsewhere', async () => {
    const page = await opened();
    await handIn(page, bar, { toward: [0, 0, 1] });
    const first = await take(page, 'cut');
    const cut = await stroke(page, [await pixel(page, [-0.8, 0.3, 0]), await pixel(page, [0.8, 0.3, 0])]);
    assert.deepEqual([cut.failures, cut.keys.length, cut.steps.undo], [[], 2, 'cut']);
    assert.deepEqual((await press(page, 'z', ['Control'])).keys, first.keys);
    await take(page, 'line');
    const lined = await stroke(page, [await pixel(page, [-0.3, -1, 0.5]), await pixel(page, [0.3, 1, 0.5])]);
    assert.deepEqual(lined.failures, []);
    assert.ok(await page.evaluate(() => window.lissomView.drawn.lines.count > 4));
    await press(page, 'z', ['Control']);
    await take(page, 'bones');
    const laid = await stroke(page, [await pixel(page, [0, -1.7, 0.5]), await pixel(page, [0, 1.7, 0.5])]);
    assert.deepEqual(laid.failures, []);
    const tip = await pixel(page, [0, 1.7, 0]);
    const bent = await stroke(page, [tip, [tip[0] + 60, tip[1] + 20]]);
    assert.deepEqual(bent.failures, []);
    assert.notEqual(bent.keys[0], first.keys[0]);
    await shot(page, 'hand_bones');
    await page.close();
});

test('hair is shaken while the button is down, and hangs as before afterwards', async () => {
    const page = await opened();
    await handIn(page, `local lissom = require "lissom"
local head = lissom.shapes.head{ vertices = 3000 }
local style = lissom.hairstyle(head, { resolution = 20000 })
for _, side in ipairs{ -1, 1 } do
    style:add_stream{ style:at{ azimuth = 10 * side, elevation = 60 }, style:at{ azimuth = 90 * side, elevation = 0 } }
end
local hair = style:grow{ count = 400, length = 0.2 }
lissom.render{ mesh = head, strands = hair, file = "hair.png" }
return style`);
    const before = await take(page, 'dynamics'), middle = await pixel(page, [0, 0, 0]);
    await page.mouse.move(...middle);
    await page.mouse.down();
    await page.mouse.move(middle[0] + 120, middle[1], { steps: 4 });
    await page.waitForFunction(key => window.lissomHand.last.keys[1] !== key, { timeout: patience }, before.keys[1]);
    await page.mouse.up();
    const after = await answered(page);
    assert.deepEqual([after.failures, after.keys], [[], before.keys]);
    await page.close();
});

test('the style of a preset is drawn on', async () => {
    const text = fs.readFileSync(new URL('../../scripts/presets/bob.lua', import.meta.url), 'utf8');
    const link = await toLink({ script: text, values: { vertices: 3000, count: 2000, resolution: 20000, format: 'hair' }, name: 'bob.lua', picture: 'bob_front' });
    const page = await opened(`#s=${link}`);
    assert.equal((await last(page)).error, undefined);
    const before = await take(page, 'stream');
    assert.deepEqual([before.failures, before.keys.length], [[], 2]);
    const top = await pixel(page, await farthest(page, [0, 1, 0]));
    const drawn = await stroke(page, [[top[0] + 30, top[1] + 40], [top[0] + 110, top[1] + 110], [top[0] + 130, top[1] + 240]]);
    assert.deepEqual([drawn.failures, drawn.keys.length], [[], 2]);
    assert.notEqual(drawn.keys[1], before.keys[1]);
    await shot(page, 'hand_preset');
    await page.close();
});

test('a file that is too large is refused, with a way out', async () => {
    const page = await opened(), before = await count(page);
    await page.evaluate(() => {
        const file = new File(['v'], 'scan.obj');
        Object.defineProperty(file, 'size', { value: 5e8 });
        const drop = Object.assign(new Event('drop', { cancelable: true }), { dataTransfer: { files: [file], types: ['Files'] } });
        window.dispatchEvent(drop);
    });
    assert.match(await page.$eval('#note', node => node.textContent), /scan\.obj has 500 MB.*program/);
    assert.equal(await count(page), before);
    await page.close();
});

test('without WebGL 2 scripts run, and the page says why there is no picture', async () => {
    const page = await opened('', { width: 1400, height: 900 }, () => {
        const get = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (kind, ...more) { return kind === 'webgl2' ? null : get.call(this, kind, ...more); };
    });
    assert.equal((await last(page)).ok, true);
    assert.match(await page.$eval('#no-picture', node => node.textContent), /WebGL 2.*another browser/);
    await shot(page, 'no_webgl');
    await page.close();
});

test('a browser that is too old for the library says which ones are not, and keeps the script', async () => {
    const context = await browser.createBrowserContext(), page = await context.newPage();
    await page.evaluateOnNewDocument(() => {
        window.WebAssembly.validate = () => false;
        window.Worker = class {
            postMessage() { setTimeout(() => this.onmessage({ data: { kind: 'failed', message: 'CompileError: invalid opcode' } })); }
            terminate() {}
        };
    });
    await page.goto(address);
    await page.waitForFunction(() => /lacks exceptions.*Firefox 100/.test(document.getElementById('console').textContent), { timeout: patience });
    assert.match(await page.evaluate(() => window.lissomEditor.text), /lissom/);
    await page.click('#share');
    await page.waitForFunction(() => window.lissomLink, { timeout: patience });
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

// Of what a visitor does, that which breaks with most.
const few = ['the first visit', 'a hand turns the view', 'an edited line runs', 'a link holds', 'a script without an end', 'a dropped mesh',
    'with the tool deform', 'streams, a parting and a tail', 'one finger is', 'examples run'];
const isWanted = ({ name }) => name.includes(only) && (!options.includes('--few') || few.some(start => name.startsWith(start)));

const only = options.includes('--only') ? options[options.indexOf('--only') + 1] : '';
let failed = 0, done = 0;
for (const { name, check } of cases.filter(isWanted)) {
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
