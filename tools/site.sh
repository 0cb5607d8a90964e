#!/usr/bin/env bash
# Builds the site from the pages of the project into target/site/html: `tools/site.sh`. Needs python3, and fetches the
# generator once, into target/site/venv. A link that leads nowhere is an error. Where target/release/ppum is built, the
# site has live pages of two examples.
set -euo pipefail
cd "$(dirname "$0")/.."

readonly SITE=target/site
readonly GENERATOR=$SITE/venv/bin/zensical
mkdir -p "$SITE"
if ! [[ -x $GENERATOR && tools/site/requirements.txt -ot $GENERATOR ]]; then
    python3 -m venv --clear "$SITE/venv"
    "$SITE/venv/bin/pip" install --quiet --disable-pip-version-check -r tools/site/requirements.txt
    touch "$GENERATOR"
fi
python3 tools/site/pages.py "$SITE/pages"
cp tools/site/site.css tools/site/site.js "$SITE/pages/"
# the reference of the Python package, from docstrings whose examples have the name that the generator takes for them
cp tools/site/python-api.md.in "$SITE/pages/docs/python-api.md"
rm -rf "$SITE/package"
cp -r crates/ppum-python/python "$SITE/package"
find "$SITE/package" -name '*.py' -exec sed -i -E 's/^( +)?Example:$/\1Examples:/' {} +
cp tools/site/site.yml "$SITE/mkdocs.yml"
if [[ -x target/release/ppum ]]; then
    cp tools/site/live.md.in "$SITE/pages/docs/live.md"
    mkdir -p "$SITE/pages/docs/demo"
    for name in centre-crack edge-shear-growth; do
        target/release/ppum solve "examples/$name.toml" -o "$SITE/$name.h5" >/dev/null 2>&1
        target/release/ppum export "$SITE/$name.h5" -o "$SITE/pages/docs/demo/$name.html" --step 0
    done
else
    sed -i '/docs\/live.md/d' "$SITE/mkdocs.yml"
fi
"$GENERATOR" build --clean --strict -f "$SITE/mkdocs.yml"
du -sh "$SITE/html"
