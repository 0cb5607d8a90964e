#!/bin/sh
# Drives the real window under Xvfb with a real mouse and real keys, and keeps a picture of each state: of all that
# docs/window.md shows and of what one looks at to judge it.
# Needs xvfb, xdotool and imagemagick (Debian's names), and a program that was built with the window:
#     cargo build --release --features window
#     tools/window.sh target/release/ppum DATASET.h5 FOLDER [WIDTHxHEIGHT]
set -eu
program=$1 dataset=$2 folder=$3 size=${4:-1280x800}
mkdir -p "$folder"
home=$(mktemp -d)
export PPUM_CONFIG="$home" XDG_RUNTIME_DIR="$home"
# The server writes its number when it takes clients; without -noreset it takes none for a while each time the last
# of them has left.
Xvfb -displayfd 3 -noreset -screen 0 "${size}x24" 3>"$home/display" >/dev/null 2>&1 &
server=$!
trap 'kill $server 2>/dev/null; rm -rf "$home"' EXIT

# Tries a command every half second until it succeeds, a minute at most.
until_it_does() {
    tries=0
    until "$@"; do
        tries=$((tries + 1))
        [ "$tries" -lt 120 ] || { echo "never succeeded: $*" >&2; exit 1; }
        sleep 0.5
    done
}
until_it_does test -s "$home/display"
DISPLAY=":$(cat "$home/display")"
export DISPLAY

is_there() { id=$(xdotool search --name 'ppum$' 2>/dev/null | tail -1) && [ -n "$id" ]; }

# Begins a window and waits until it is there.
begin() {
    "$program" view --size "$size" "$@" &
    window=$!
    until_it_does is_there
    until_it_does xdotool windowfocus "$id"      # it may have to be mapped first
    sleep 3
}

# Ends it as its user would.
end() {
    xdotool key ctrl+q
    wait "$window"
}

# Keeps a picture of the screen; fails where it shows an empty window.
shows_something() {
    import -window root "$1"
    [ "$(identify -format %k "$1")" -gt 30 ]
}
picture() {
    sleep 1.5
    until_it_does shows_something "$folder/$1.png"
}
press() { for key in "$@"; do xdotool key "$key"; sleep 0.4; done; }
move() { xdotool mousemove "$1" "$2"; sleep 0.5; }
wheel() { i=0; while [ "$i" -lt "$2" ]; do xdotool click "$1"; sleep 0.03; i=$((i + 1)); done; }
drag() {
    move "$1" "$2"; xdotool mousedown 1; sleep 0.2
    xdotool mousemove "$((($1 + $3) / 2))" "$((($2 + $4) / 2))"; sleep 0.2
    xdotool mousemove "$3" "$4"; sleep 0.2; xdotool mouseup 1; sleep 0.4
}

begin
picture start
end

begin "$dataset"
move 300 250
picture plate
press 2; sleep 2; move 420 330
picture tip
i=0; while [ "$i" -lt 43 ]; do xdotool key plus; sleep 0.05; i=$((i + 1)); done; sleep 2
picture deep
move 480 400; wheel 4 60; sleep 2
picture deepest
press f; sleep 2; press i
picture isolines
press i d; sleep 2
picture deformed
press d c; sleep 2
picture compared
press c x; sleep 2
picture opening
press x; press 1; sleep 2; press k; sleep 2
picture integral
press k t; sleep 1
picture tips
press t f; sleep 2; press h
picture keys
press h ctrl+k; xdotool type tip; sleep 0.5; picture palette
press Escape v; sleep 2
picture two
press shift+v q; xdotool type tresca; sleep 0.5; press Return; move 560 300; sleep 2
picture difference
press shift+v v; drag 300 300 420 360; picture dragged
press ctrl+z; picture undone
end
