// The hair that we write as .usda is read by a reader that is not ours, tinyusdz, with the same numbers.
//     node readers_test.mjs PROGRAM
// PROGRAM is lissom. The package is looked for in the folder LISSOM_NPM, or in ~/.cache/lissom/npm; `./dev test`
// fetches it. Exits with 77 if it is not there.
import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { homedir, tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const [program] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const packages = process.env.LISSOM_NPM ?? join(homedir(), ".cache", "lissom", "npm");
const reader = join(packages, "node_modules", "tinyusdz");
if (!existsSync(reader)) {
    console.log(`skipped: no reader of USD in ${packages}`);
    process.exit(77);
}

let passed = 0;
let failed = 0;
function check(good, what) {
    good ? ++passed : ++failed;
    if (!good) console.log(`FAILED: ${what}`);
}

// It is built for browsers alone: while it starts, this looks like one of their workers.
async function makeReader() {
    const { process } = globalThis;
    Object.assign(globalThis, { WorkerGlobalScope: class {}, self: globalThis, location: { href: "file:///" } });
    const { default: create } = await import(pathToFileURL(join(reader, "tinyusdz.js")).href);
    globalThis.process = undefined;
    const module = await create({ wasmBinary: readFileSync(join(reader, "tinyusdz.wasm")) });
    globalThis.process = process;
    return module;
}

// The numbers of each attribute of a layer's text whose value is a list, and the texts of the others.
function attributesOf(text) {
    const found = new Map();
    const name = /^\s*(?:custom |uniform )*[a-z0-9]+\d*[a-z]*(?:\[\])? ([\w:]+) = (\[[^\]]*\]|\(\s*\([^[\]]*?\)\s*\))/gm;
    for (const [, key, value] of text.matchAll(name)) {
        const isText = value.includes('"');
        found.set(key, isText ? value.match(/"[^"]*"/g) : (value.match(/[-+.\de]+/g) ?? []).map(Number));
    }
    return found;
}

// It writes 32-bit numbers with fewer digits.
function same(ours, theirs) {
    const near = (a, b) => (typeof a === "number" ? Math.abs(a - b) <= 1e-6 * Math.max(1, Math.abs(a)) : a === b);
    return ours.length === theirs?.length && ours.every((value, i) => near(value, theirs[i]));
}

function compare(module, folder, file) {
    const bytes = readFileSync(join(folder, file));
    const scene = new module.TinyUSDZLoaderNative();
    check(scene.loadFromBinary(bytes, file), `${file}: as a scene: ${scene.error()}`);
    const loader = new module.TinyUSDZLoaderNative();
    check(loader.loadAsLayerFromBinary(bytes, file), `${file}: as a layer: ${loader.error()}`);
    const ours = attributesOf(bytes.toString());
    const layer = loader.layerToString();
    const theirs = attributesOf(layer);
    check(ours.get("points")?.length > 1000, `${file}: ${ours.get("points")?.length} coordinates`);
    // It forgets schemas that it does not know.
    ours.delete("apiSchemas");
    for (const [name, values] of ours) check(same(values, theirs.get(name)), `${file}: ${name} differs`);
    const isBound = file.startsWith("bound");
    check(isBound === ours.has("primvars:skel:jointIndices"), `${file}: joints of points`);
    check(isBound === /def Skeleton "Skeleton"/.test(layer), `${file}: the skeleton`);
    check(isBound === /skel:skeleton = <\/Groom\/Skeleton>/.test(layer), `${file}: the binding`);
    check(!isBound || ours.get("joints").length === 4, `${file}: ${ours.get("joints")}`);
}

const folder = mkdtempSync(join(tmpdir(), "lissom-usda-"));
try {
    const run = spawnSync(program, ["run", join(here, "written.lua"), "--out", folder], { stdio: "inherit" });
    check(run.status === 0, "the hair was not written");
    const module = await makeReader();
    for (const file of readdirSync(folder)) compare(module, folder, file);
} finally {
    rmSync(folder, { recursive: true });
}
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed === 0 && passed > 0 ? 0 : 1);
