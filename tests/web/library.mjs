// Opens the module of JavaScript with the library inside, in node.
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

// Returns { module, log, ask(function, values), answer(), run(script, values), open() }.
export async function openLibrary(folder) {
    // The module was made for node as it was before it had modules of its own.
    globalThis.require = createRequire(import.meta.url);
    globalThis.__dirname = path.resolve(folder);
    const { default: create } = await import(pathToFileURL(path.resolve(folder, 'lissom.mjs')));
    const log = [];
    const module = await create({ wasmBinary: fs.readFileSync(path.join(folder, 'lissom.wasm')), lissomLog: (level, text) => log.push(text),
        print: text => log.push(text), printErr: text => log.push(text) });
    const kind = value => (typeof value === 'number' ? 'number' : 'string');
    const answer = () => JSON.parse(module.ccall('page_answer', 'string', [], []));
    const ask = (name, ...values) => {
        if (module.ccall(name, 'boolean', values.map(kind), values)) return true;
        throw Object.assign(new Error(answer().message), answer());
    };
    const run = (script, values = {}) => {
        ask('page_load', script, 'script.lua');
        const parameters = answer();
        for (const [name, value] of Object.entries(values)) ask('page_set', name, String(value));
        ask('page_run', '');
        return { results: answer(), parameters };
    };
    ask('page_open', 0);
    return { module, log, ask, answer, run };
}
