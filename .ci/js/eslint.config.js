import js from "@eslint/js";
import globals from "globals";

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
  { files: ["tests/**"], languageOptions: { globals: globals.node } },
];
