// Validates one GLB with the Khronos validator: prints its findings and the totals as JSON, exits 1 on any error or
// warning. Usage: node validate.js FILE.glb
const fs = require('fs');
const validator = require('gltf-validator');

const bytes = new Uint8Array(fs.readFileSync(process.argv[2]));
validator.validateBytes(bytes, {format: 'glb', maxIssues: 20}).then((report) => {
  console.log(JSON.stringify({issues: report.issues, info: report.info}, null, 1));
  process.exit(report.issues.numErrors + report.issues.numWarnings > 0 ? 1 : 0);
}).catch((error) => {
  console.error(String(error));
  process.exit(1);
});
