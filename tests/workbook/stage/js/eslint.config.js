import js from "@eslint/js";
import globals from "globals";

export default [
  js.configs.recommended,
  {
    languageOptions: { ecmaVersion: 2023, sourceType: "module", globals: { ...globals.browser } },
    linterOptions: { reportUnusedDisableDirectives: "error" },
    rules: {
      eqeqeq: "error", "no-var": "error", "prefer-const": "error", "no-shadow": "error", "no-unused-vars": "error",
      "no-undef": "error", "no-implicit-globals": "error", "no-loop-func": "error", "max-len": ["error", { code: 160 }],
    },
  },
  { files: ["**/*.test.js"], languageOptions: { globals: { ...globals.node } } },
];
