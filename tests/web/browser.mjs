// A folder as a static host, and Chromium or Firefox without a window. A test without the browser or puppeteer-core is left
// out.
import fs from 'node:fs';
import http from 'node:http';
import { createRequire } from 'node:module';
import os from 'node:os';
import path from 'node:path';

// Ends with 77, as a test that is left out.
export function skip(why) {
    console.log(`skipped: ${why}`);
    process.exit(77);
}

function loadPuppeteer() {
    const npm = process.env.LISSOM_WEB_NPM || path.join(os.homedir(), '.cache', 'lissom', 'web');
    try { return createRequire(path.join(npm, 'package.json'))('puppeteer-core'); } catch { return skip('no puppeteer-core in ' + npm); }
}

async function openFirefox() {
    const firefox = ['/usr/bin/firefox-esr', '/usr/bin/firefox'].find(file => fs.existsSync(file));
    if (!firefox) skip('no Firefox');
    if (!process.env.DISPLAY) skip('Firefox has no WebGL without a display: xvfb-run');
    return loadPuppeteer().launch({ browser: 'firefox', executablePath: firefox, headless: true, protocolTimeout: 600000,
        extraPrefsFirefox: { 'webgl.force-enabled': true } });
}

// Chromium, or Firefox if LISSOM_BROWSER asks for it.
export const isFirefox = process.env.LISSOM_BROWSER === 'firefox';

export async function openBrowser() {
    if (isFirefox) return openFirefox();
    const chromium = process.env.LISSOM_CHROMIUM || ['/usr/bin/chromium', '/usr/bin/google-chrome'].find(file => fs.existsSync(file));
    if (!chromium) skip('no Chromium');
    return loadPuppeteer().launch({ executablePath: chromium, headless: true, protocolTimeout: 600000,
        args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--disable-dev-shm-usage'] });
}

const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.css': 'text/css',
    '.json': 'application/json', '.svg': 'image/svg+xml', '.png': 'image/png', '.webmanifest': 'application/manifest+json' };

// { server, address } of a folder.
export function serve(folder) {
    const root = path.resolve(folder);
    return new Promise(resolve => {
        const server = http.createServer((request, response) => {
            const file = path.join(root, decodeURIComponent(new URL(request.url, 'http://x').pathname).replace(/\/$/, '/index.html'));
            if (file !== root && !file.startsWith(root + path.sep)) return response.writeHead(403).end();
            if (!fs.existsSync(file)) return response.writeHead(404).end();
            response.writeHead(200, { 'content-type': types[path.extname(file)] || 'text/plain; charset=utf-8' });
            return fs.createReadStream(file).pipe(response);
        }).listen(0, () => resolve({ server, address: `http://localhost:${server.address().port}/` }));
    });
}
