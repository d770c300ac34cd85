// Lets V8 compile WebAssembly once and quickly: to make it faster takes longer than a test runs. Import it first.

import { setFlagsFromString } from "node:v8";

setFlagsFromString("--liftoff-only");
