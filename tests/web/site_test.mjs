// The site: its links and pictures, and its pages in Chromium, on a desk and on a phone:
//     node site_test.mjs FOLDER_OF_SITE [--all] [--pictures FOLDER]
// With --all every script of gallery, guide and reference runs in the library as WebAssembly, in node. Any error of a
// page's console fails. Ends with 77, as a test that is left out, if the site was not built, or there is no Chromium.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { openBrowser, serve, skip } from './browser.mjs';
import { openLibrary } from './library.mjs';

const [folder, ...options] = process.argv.slice(2);
if (!fs.existsSync(path.join(folder, 'search.json'))) skip('the site was not built (./dev site)');
const pictures = options.includes('--pictures') ? options[options.indexOf('--pictures') + 1] : null;
const read = name => fs.readFileSync(path.join(folder, name), 'utf8');
const pages = ['.', 'guide', 'reference'].flatMap(room => fs.readdirSync(path.join(folder, room)).filter(name => name.endsWith('.html')).map(name => path.posix.join(room, name)));
const html = new Map(pages.map(page => [page, read(page)]));
const idsOf = text => new Set([...text.matchAll(/\sid="([^"]+)"/g)].map(match => match[1]));
const ids = new Map([...html].map(([page, text]) => [page, idsOf(text)]));
const cases = [];
const test = (name, check) => cases.push({ name, check });

// Returns the fault of an address on a page, or null.
function wrong(page, href) {
    if (/^(https?:|mailto:)/.test(href)) return null;
    const [name, mark] = href.replace(/&amp;/g, '&').split('#');
    let to = name ? path.posix.join(path.posix.dirname(page), name) : page;
    if (to.endsWith('/')) to += 'index.html';
    if (!fs.existsSync(path.join(folder, to))) return `${page}: ${href} is not there`;
    if (to === 'playground/index.html') return !mark || fs.existsSync(path.join(folder, 'playground', `${mark}.json`)) ? null : `${page}: ${href} opens no script`;
    return !mark || !ids.has(to) || ids.get(to).has(mark) ? null : `${page}: ${href} has no such place`;
}

test('every link and picture is there, and every place that is linked', () => {
    let count = 0;
    const problems = [...html].flatMap(([page, text]) => [...text.matchAll(/\s(?:href|src)="([^"]*)"/g)].map(([, href]) => { ++count; return wrong(page, href); })).filter(Boolean);
    assert.deepEqual(problems, []);
    console.log(`        ${count} links of ${pages.length} pages`);
});

test('nothing is loaded from elsewhere', () => {
    for (const [page, text] of html) {
        const loaded = [...text.matchAll(/<(?:script|img|iframe|link)\b[^>]*?(?:src|href)="(https?:)?\/\//g)];
        assert.equal(loaded.length, 0, page);
    }
    assert.equal(/@import|url\(|https?:/.test(read('site.css')), false);
});

test('the gallery has a hundred pictures, each its own', () => {
    const cards = [...read('gallery.html').matchAll(/<article class="card" id="([^"]+)"/g)].map(match => match[1]);
    assert.ok(cards.length >= 100, String(cards.length));
    const seen = new Map();
    for (const id of cards) {
        const bytes = fs.readFileSync(path.join(folder, 'pictures', `${id}.png`));
        assert.ok(bytes.length > 2000, `${id}: ${bytes.length} bytes`);
        const text = bytes.toString('base64');
        assert.equal(seen.get(text), undefined, `${id} has the picture of ${seen.get(text)}`);
        seen.set(text, id);
    }
    console.log(`        ${cards.length} cards`);
});

test('the search knows every function, and leads to places that are there', () => {
    const rows = JSON.parse(read('search.json'));
    assert.deepEqual(rows.map(row => wrong('index.html', row.u)).filter(Boolean), []);
    const titles = rows.map(row => row.t);
    for (const call of ['mesh:decimate', 'lissom.merge', 'style:grow', 'shapes.cactus']) assert.ok(titles.some(title => title.includes(call)), call);
    assert.ok(rows.length > 400, String(rows.length));
});

test('scripts run in the library as WebAssembly', async () => {
    const playground = path.join(folder, 'playground'), { module, ask, run } = await openLibrary(playground);
    const put = (file, text) => {
        module.FS.mkdirTree(path.posix.dirname(file));
        module.FS.writeFile(file, text);
    };
    for (const [name, text] of Object.entries(JSON.parse(fs.readFileSync(path.join(playground, 'scripts.json'), 'utf8')))) put(`/lissom/${name}`, text);
    const prelude = fs.readFileSync(path.join(playground, 'prelude.lua'), 'utf8');
    module.FS.mkdirTree('/work');
    module.FS.chdir('/work');
    const all = fs.readdirSync(path.join(playground, 'gallery')).filter(name => options.includes('--all') || /^(mesh\.|bend\.|join\.)/.test(name)).sort();
    const failures = [];
    let slowest = { seconds: 0 };
    for (const name of all) {
        const { s, v } = JSON.parse(fs.readFileSync(path.join(playground, 'gallery', name), 'utf8')), start = performance.now();
        try {
            ask('page_open', 3.2e9);
            put('/work/script.lua', s);
            run(prelude);
            run('-- params\nreturn #playground.run("script.lua")', v);
        } catch (error) {
            failures.push(`${name}: ${error.message.split('\n')[0]}`);
        }
        const seconds = (performance.now() - start) / 1000;
        if (seconds > slowest.seconds) slowest = { name, seconds };
    }
    console.log(`        ${all.length - failures.length} of ${all.length} scripts; the slowest ${slowest.name}: ${slowest.seconds.toFixed(1)} s`);
    assert.deepEqual(failures, []);
});

// ---- In a browser

const browser = await openBrowser(), { server, address } = await serve(folder);
const troubles = [];
const desk = { width: 1400, height: 900 }, phone = { width: 390, height: 844, deviceScaleFactor: 2, hasTouch: true, isMobile: true };

async function opened(page, size = desk, theme = 'light') {
    const context = await browser.createBrowserContext(), tab = await context.newPage();
    await tab.setViewport(size);
    await tab.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: theme }]);
    tab.on('console', message => { if (['error', 'warn'].includes(message.type()) && !/GPU stall|GL Driver Message/.test(message.text())) troubles.push(`${page}: ${message.text()}`); });
    tab.on('pageerror', error => troubles.push(`${page}: ${error}`));
    tab.on('request', request => { if (!/^(data|blob):/.test(request.url()) && !request.url().startsWith(address)) troubles.push(`elsewhere: ${request.url()}`); });
    await tab.goto(address + page, { waitUntil: 'load' });
    return tab;
}

async function shot(tab, name, whole = false) {
    if (!pictures) return;
    fs.mkdirSync(pictures, { recursive: true });
    await new Promise(resolve => setTimeout(resolve, 500));
    await tab.screenshot({ path: path.join(pictures, `${name}.png`), fullPage: whole });
}

test('the start page opens an example in place', async () => {
    const tab = await opened('');
    await shot(tab, 'start');
    await tab.click('[data-live=bend]');
    const frame = await (await tab.waitForSelector('.stage iframe')).contentFrame();
    await frame.waitForFunction(() => window.lissomRuns > 0, { timeout: 240000 });
    assert.equal(await frame.evaluate(() => window.lissomLast.ok), true);
    await shot(tab, 'start_live');
    const dark = await opened('', desk, 'dark');
    await shot(dark, 'start_dark');
    await Promise.all([tab.close(), dark.close()]);
});

test('an example of the reference runs in place', async () => {
    const tab = await opened('reference/mesh.html#decimate');
    await tab.evaluate(() => { document.querySelector('[data-run="mesh.decimate"]').scrollIntoView({ block: 'center' }); });
    await shot(tab, 'reference');
    await tab.click('[data-run="mesh.decimate"]');
    const frame = await (await tab.waitForSelector('.example iframe')).contentFrame();
    await frame.waitForFunction(() => window.lissomRuns > 0, { timeout: 240000 });
    assert.equal(await frame.evaluate(() => window.lissomLast.ok), true);
    assert.ok(await frame.evaluate(() => window.lissomView.picture?.meshes.length !== 0));
    await tab.evaluate(() => { document.querySelector('.example iframe').scrollIntoView({ block: 'center' }); });
    await shot(tab, 'reference_running');
    await tab.close();
});

test('a word that is searched leads to its page, and the theme stays', async () => {
    const tab = await opened('guide/hair.html');
    await shot(tab, 'guide');
    await tab.keyboard.press('/');
    await tab.keyboard.type('decimate', { delay: 20 });
    await tab.waitForSelector('.found a');
    await shot(tab, 'search');
    await Promise.all([tab.waitForNavigation(), tab.keyboard.press('Enter')]);
    assert.match(tab.url(), /reference\/mesh\.html#decimate$/);
    await tab.click('#theme');
    await tab.reload();
    assert.equal(await tab.evaluate(() => document.documentElement.dataset.theme), 'dark');
    await shot(tab, 'reference_dark');
    await tab.close();
});

test('the gallery is filtered by group and difficulty', async () => {
    const tab = await opened('gallery.html');
    const visible = () => tab.evaluate(() => [...document.querySelectorAll('.card')].filter(card => card.getBoundingClientRect().height > 0).length);
    await tab.evaluate(async () => { for (const image of document.images) image.loading = 'eager'; await Promise.all([...document.images].map(image => image.decode())); });
    await shot(tab, 'gallery', true);
    const all = await visible();
    await tab.click('[data-group=Hairstyles]');
    assert.equal(await visible(), 26);
    await tab.click('[data-level=advanced]');
    assert.equal(await visible(), 0);
    await tab.click('.filters [data-group=""]');
    const some = await visible();
    assert.ok(some > 5 && some < all, `${some} of ${all}`);
    await tab.close();
});

test('every page fits on a phone', async () => {
    const tab = await opened('', phone);
    await shot(tab, 'phone_start', true);
    const wide = [];
    for (const page of pages) {
        await tab.goto(address + page, { waitUntil: 'domcontentloaded' });
        const width = await tab.evaluate(() => document.documentElement.scrollWidth);
        if (width > phone.width) wide.push(`${page}: ${width}`);
        if (['gallery.html', 'guide/hair.html', 'reference/mesh.html'].includes(page)) await shot(tab, `phone_${page.replace(/\W/g, '_')}`);
    }
    assert.deepEqual(wide, []);
    await tab.close();
});

let failed = 0;
for (const { name, check } of cases) {
    troubles.length = 0;
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
console.log(`${cases.length - failed} of ${cases.length} passed`);
process.exit(failed ? 1 : 0);
