#!/bin/sh
# Writes crates/ppum-figure/data/DejaVuSans-subset.ttf: Latin, Greek, super- and subscripts and
# mathematical signs of DejaVu Sans, with the box that stands for all others, without hinting and layout tables, which figures do not use;
# and the letters of the window in crates/ppum-viewer/data: the same with the signs of buttons, and a face of one width for
# texts that are edited.
# Needs a virtual environment with matplotlib (it carries the font) and fonttools:
#     python3 -m venv venv && venv/bin/pip install matplotlib fonttools
#     tools/font.sh venv/bin
set -eu
bin=$1
data=$(dirname "$0")/../crates/ppum-figure/data
fonts=$("$bin/python" -c 'import matplotlib; print(matplotlib.get_data_path())')/fonts/ttf
latin=U+0020-007E,U+00A0-017F,U+2010-2015,U+2018-201D,U+2026,U+FFFD
greek=U+0391-03A9,U+03B1-03C9,U+03D1,U+03D5,U+03F5
marks=U+2032,U+2033,U+2070-209C,U+2190-2194
signs=U+2200-220D,U+2211-2215,U+221A,U+221D-2220,U+2225-222B,U+2248,U+2260-2265,U+226A,U+226B
all="$latin,$greek,$marks,$signs,U+22C5,U+27E8,U+27E9"
subset() {
    "$bin/pyftsubset" "$fonts/$1.ttf" --output-file="$2" --unicodes="$3" \
        --notdef-outline --no-hinting --layout-features= --drop-tables+=MATH,GPOS,GSUB,GDEF,gasp,FFTM \
        --name-IDs=0,1,2,3,4,5,6,13,14
}
subset DejaVuSans "$data/DejaVuSans-subset.ttf" "$all"
cp "$fonts/LICENSE_DEJAVU" "$data/LICENSE_DEJAVU"

window=$(dirname "$0")/../crates/ppum-viewer/data
buttons=U+2190-21FF,U+2300-23FF,U+2460-2473,U+25A0-25FF,U+2600-263F,U+2690-26A1,U+2713-2718
mkdir -p "$window"
subset DejaVuSans "$window/DejaVuSans-window.ttf" "$all,$buttons"
subset DejaVuSansMono "$window/DejaVuSansMono-window.ttf" "$all"
cp "$fonts/LICENSE_DEJAVU" "$window/LICENSE_DEJAVU"
