#!/usr/bin/env bash
# Compiles the evaluator of pages into crates/ppum-page/evaluator.wasm.gz, which `ppum export` puts into them. Needs the
# target wasm32-unknown-unknown of rustup, and perl. Run it when a crate that ppum-page depends on has changed what it
# computes or draws; tests/page finds out if that was forgotten.
set -euo pipefail
cd "$(dirname "$0")/.."
readonly TARGET=wasm32-unknown-unknown OUT=crates/ppum-page/evaluator.wasm.gz
readonly WASM=${CARGO_TARGET_DIR:-target}/$TARGET/page/ppum_page.wasm
RUSTFLAGS='-C target-feature=+simd128' cargo rustc --locked --profile page --target "$TARGET" \
    -p ppum-page --lib --crate-type cdylib
# Messages of foreign crates name files of this machine; other texts of the same length take the place of folders.
perl -0777 -pe 's{(/[\w./-]*?/registry/src/[^/\0]*/)}{"cargo" . "/" x (length($1) - 5)}ge' "$WASM" | gzip -9nc >"$OUT"
ls -l "$WASM" "$OUT"
