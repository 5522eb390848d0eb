// Runs Khronos' validator over glTF files: node validate.mjs FILE...
// Prints the errors of each file and exits with status 1 where there are any. Images that a file
// refers to but that are not there do not count. The package gltf-validator (npm) is looked for
// from the working directory.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";

const require = createRequire(join(process.cwd(), "package.json"));
const validator = require("gltf-validator");

let failed = 0;
for (const file of process.argv.slice(2)) {
    const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
        uri: basename(file),
        maxIssues: 1000,
        externalResourceFunction: async (uri) =>
            new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri)))),
    });
    const errors = report.issues.messages.filter(
        (issue) => issue.severity === 0 && issue.code !== "IO_ERROR");
    if (errors.length === 0) continue;
    failed += 1;
    console.log(`${file}: ${errors.length} errors`);
    for (const issue of errors) {
        console.log(`    ${issue.code} ${issue.pointer ?? ""} ${issue.message}`);
    }
}
console.log(`${process.argv.length - 2 - failed} of ${process.argv.length - 2} files have no error`);
process.exit(failed === 0 ? 0 : 1);
