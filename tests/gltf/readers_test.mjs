// What we write is read by readers that are not ours: Khronos' validator, glTF-Transform with the decoders of
// Draco and meshoptimizer; and our tangents are those of MikkTSpace's own code.
//     node readers_test.mjs PROGRAM TANGENTS_OF DATA
// PROGRAM is lissom, TANGENTS_OF the program of tangents_of.cpp, DATA the folder of real models, which may be
// missing. The packages of package.json are looked for in the folder LISSOM_NPM, or in ~/.cache/lissom/npm;
// `./dev test` fetches them. Exits with 77 if they are not there.
import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { homedir, tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const [program, tangentsOf, data] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const packages = process.env.LISSOM_NPM ?? join(homedir(), ".cache", "lissom", "npm");
if (!existsSync(join(packages, "node_modules", "mikktspace"))) {
    console.log(`skipped: no readers of glTF in ${packages}`);
    process.exit(77);
}
const require = createRequire(join(packages, "package.json"));
const validator = require("gltf-validator");
const { Logger, NodeIO } = require("@gltf-transform/core");
const { ALL_EXTENSIONS } = require("@gltf-transform/extensions");
const { MeshoptDecoder } = require("meshoptimizer");
const { generateTangents } = require("mikktspace");

let passed = 0;
let failed = 0;
function check(good, what) {
    good ? ++passed : ++failed;
    if (!good) console.log(`FAILED: ${what}`);
}

async function makeReader() {
    await MeshoptDecoder.ready;
    const quiet = new Logger(Logger.Verbosity.ERROR);
    return new NodeIO().setLogger(quiet).registerExtensions(ALL_EXTENSIONS).registerDependencies({
        "draco3d.decoder": await require("draco3dgltf").createDecoderModule(),
        "meshopt.decoder": MeshoptDecoder,
    });
}

// ---- Compressed files

async function isValid(file) {
    const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), { uri: basename(file) });
    const errors = report.issues.messages.filter((issue) => issue.severity === 0);
    check(errors.length === 0, `${basename(file)}: ${errors.map((e) => `${e.code} ${e.pointer}`).join(", ")}`);
}

// The corners of all triangles, a list of numbers for each attribute and target.
function cornersOf(document) {
    const lists = new Map();
    let corners = 0;
    const add = (name, accessor, index) => {
        if (!lists.has(name)) lists.set(name, []);
        const element = [];
        for (const i of index) lists.get(name).push(...accessor.getElement(i, element));
    };
    for (const mesh of document.getRoot().listMeshes()) {
        for (const primitive of mesh.listPrimitives()) {
            const index = primitive.getIndices().getArray();
            corners += index.length;
            for (const name of primitive.listSemantics()) add(name, primitive.getAttribute(name), index);
            primitive.listTargets().forEach((target, t) => {
                for (const name of target.listSemantics()) add(`${t} ${name}`, target.getAttribute(name), index);
            });
        }
    }
    return { lists, corners };
}

function greatestDifference(a, b) {
    let greatest = a.length === b.length ? 0 : Infinity;
    for (let i = 0; i < a.length && i < b.length; ++i) greatest = Math.max(greatest, Math.abs(a[i] - b[i]));
    return greatest;
}

// Joints and weights of a vertex may stand in any order, and are never quantised.
function toleranceOf(name, bits, size) {
    if (bits === 0) return 0;
    if (name.endsWith("POSITION")) return (2 * size) / 2 ** bits;
    if (name.endsWith("NORMAL") || name.endsWith("TANGENT")) return 2 / 2 ** Math.max(8, bits / 2);
    return name.startsWith("TEXCOORD") ? 2 / 2 ** bits : 0;
}

function compare(name, plain, other, bits, size) {
    check(plain.corners === other.corners, `${name}: ${other.corners} corners, not ${plain.corners}`);
    check([...plain.lists.keys()].sort().join() === [...other.lists.keys()].sort().join(), `${name}: attributes`);
    for (const [attribute, values] of plain.lists) {
        const difference = greatestDifference(values, other.lists.get(attribute) ?? []);
        const tolerance = toleranceOf(attribute, bits, size);
        check(difference <= tolerance, `${name}: ${attribute} differs by ${difference}, not ${tolerance}`);
    }
}

function structureOf(document) {
    const root = document.getRoot();
    const joints = root.listSkins().map((skin) => skin.listJoints().length);
    const keys = root.listAnimations().flatMap((animation) =>
        animation.listSamplers().map((sampler) => [...sampler.getInput().getArray(),
            ...sampler.getOutput().getArray()]));
    return JSON.stringify({ joints, keys, materials: root.listMaterials().map((m) => m.getName()).sort() });
}

function compareBounds(name, corners, told) {
    const positions = corners.lists.get("POSITION");
    for (let axis = 0; axis < 3; ++axis) {
        const values = positions.filter((_, i) => i % 3 === axis);
        const least = values.reduce((a, b) => Math.min(a, b));
        const greatest = values.reduce((a, b) => Math.max(a, b));
        const good = Math.abs(least - told.min[axis]) < 1e-5 && Math.abs(greatest - told.max[axis]) < 1e-5;
        check(good, `${name}: from ${least} to ${greatest} along axis ${axis}`);
    }
}

async function readWritten(folder) {
    const reader = await makeReader();
    for (const plainFile of readdirSync(folder).filter((f) => f.endsWith("_plain.glb"))) {
        const model = plainFile.slice(0, -"_plain.glb".length);
        await isValid(join(folder, plainFile));
        const document = await reader.read(join(folder, plainFile));
        const plain = cornersOf(document);
        const told = JSON.parse(readFileSync(join(folder, `${model}.json`)));
        compareBounds(plainFile, plain, told);
        const size = Math.max(...told.max.map((m, axis) => m - told.min[axis]));
        for (const file of readdirSync(folder).filter((f) => f.startsWith(`${model}_`) && f !== plainFile)) {
            await isValid(join(folder, file));
            const other = await reader.read(join(folder, file));
            const bits = Number(/_(\d+)\.glb$/.exec(file)?.[1] ?? 0);
            compare(file, plain, cornersOf(other), bits, size);
            check(structureOf(other) === structureOf(document), `${file}: skins, animations or materials differ`);
        }
    }
}

// ---- Tangents

function angleBetween(a, b) {
    const length = (v) => Math.hypot(...v) || 1;
    const cosine = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / length(a) / length(b);
    return (Math.acos(Math.min(1, Math.max(-1, cosine))) * 180) / Math.PI;
}

function compareTangents(model, folder) {
    const output = join(folder, "corners.bin");
    if (spawnSync(tangentsOf, [model, output], { stdio: "inherit" }).status !== 0) {
        check(false, `${model}: no tangents`);
        return;
    }
    const bytes = readFileSync(output);
    const corners = new Float32Array(bytes.buffer, bytes.byteOffset, bytes.length / 4);
    const count = corners.length / 12;
    const pick = (first, width) => {
        const list = new Float32Array(width * count);
        for (let i = 0; i < count; ++i) list.set(corners.subarray(12 * i + first, 12 * i + first + width), width * i);
        return list;
    };
    const theirs = generateTangents(pick(0, 3), pick(3, 3), pick(6, 2));
    const ours = pick(8, 4);
    const angles = [];
    let mirrored = 0;
    for (let i = 0; i < count; ++i) {
        angles.push(angleBetween(ours.subarray(4 * i, 4 * i + 3), theirs.subarray(4 * i, 4 * i + 3)));
        mirrored += ours[4 * i + 3] * theirs[4 * i + 3] < 0 ? 1 : 0;
    }
    angles.sort((a, b) => a - b);
    const quantile = (q) => angles[Math.min(count - 1, Math.floor(q * count))];
    const apart = angles.filter((a) => a > 0.1).length;
    console.log(`${basename(model)}: ${count} corners, ${apart} tangents differ by more than 0.1 degrees, ` +
        `99.9 % by ${quantile(0.999).toFixed(4)} at most, the greatest by ${quantile(1).toFixed(3)}; ` +
        `${mirrored} signs differ`);
    check(count > 0 && apart <= 0.0005 * count, `${model}: ${apart} of ${count} tangents differ`);
    check(mirrored <= 0.0005 * count, `${model}: ${mirrored} of ${count} signs differ`);
}

const folder = mkdtempSync(join(tmpdir(), "lissom-readers-"));
try {
    const run = spawnSync(program, ["run", join(here, "written.lua"), "--out", folder], { stdio: "inherit" });
    check(run.status === 0, "the models were not written");
    await readWritten(folder);
    compareTangents(join(folder, "sphere_plain.glb"), folder);
    for (const model of ["gltf/draco_Duck.glb", "heads/african_head.obj", "models/hornbug.obj"]) {
        if (!data || !existsSync(join(data, model))) {
            console.log(`skipped: no ${model}`);
            check(process.env.LISSOM_REQUIRE_DATA !== "1", `${model} is required`);
            continue;
        }
        compareTangents(join(data, model), folder);
    }
} finally {
    rmSync(folder, { recursive: true });
}
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed === 0 && passed > 0 ? 0 : 1);
