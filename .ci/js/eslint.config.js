import { fileURLToPath } from "node:url";

import js from "@eslint/js";
import globals from "globals";
import typescript from "typescript-eslint";

export default [
  { ignores: ["**/vendor/"] },
  js.configs.recommended,
  {
    languageOptions: { globals: { ...globals.browser, Blockly: "readonly" } },
    rules: {
      complexity: ["error", 15], "max-len": ["error", 120], eqeqeq: "error", "no-var": "error", "prefer-const": "error",
      "no-unused-vars": ["error", { argsIgnorePattern: "^_", varsIgnorePattern: "^_" }],
      "require-yield": "off", // each block is a generator
    },
  },
  {
    files: ["morbot_ws/**"],
    rules: {
      "max-lines": ["error", { max: 200, skipBlankLines: true, skipComments: true }],
      "max-lines-per-function": ["error", { max: 25, skipBlankLines: true, skipComments: true }],
    },
  },
  { // a promise is awaited, or void says that nobody waits for it
    files: ["morbot_ws/**"],
    plugins: { typescript: typescript.plugin },
    languageOptions: {
      parser: typescript.parser,
      parserOptions: { project: fileURLToPath(new URL("tsconfig.json", import.meta.url)) },
    },
    rules: {
      "typescript/no-floating-promises": "error", "typescript/no-misused-promises": "error",
    },
  },
  { files: ["tests/**"], languageOptions: { globals: globals.node } },
];
