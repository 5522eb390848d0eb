// What the kernel makes of generated shapes as WebAssembly, beside the preset portable:
//     node hashes.mjs WASM_HASHES.js PLATFORM_HASHES
// Sums of coordinates agree to nine digits; rows that are equal to the bit are counted.
import { execFileSync } from 'node:child_process';

const [wasm, native] = process.argv.slice(2);
// Names have spaces.
const rows = text => text.trim().split('\n').map(line => /^(.*\S)\s+(\S+)\s+(\S+)$/.exec(line).slice(1));
const ours = rows(execFileSync(process.execPath, ['--no-experimental-fetch', wasm], { encoding: 'utf8' }));
const theirs = rows(execFileSync(native, [], { encoding: 'utf8' }));
let equal = 0, far = 0;
theirs.forEach(([name, hash, sum], i) => {
    const same = ours[i]?.[0] === name && ours[i][1] === hash;
    const off = ours[i]?.[0] === name ? Math.abs(ours[i][2] / sum - 1) : Infinity;
    equal += same;
    far += !(same || off < 1e-9);
    console.log(`${name.padEnd(24)} ${hash} ${ours[i]?.[1]} ${same ? 'equal' : off.toExponential(1)}`);
});
console.log(`${equal} of ${theirs.length} equal to the bit`);
process.exit(far || ours.length !== theirs.length ? 1 : 0);
