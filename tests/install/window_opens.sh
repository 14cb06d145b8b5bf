#!/bin/sh
# window_opens.sh KERF FOLDER: the window opens on a virtual display and closes with code 0. FOLDER is for its settings.
# tests/viewer/window_test.py tells what it shows. Needs Xvfb and xdotool.
kerf=$1
export XDG_CONFIG_HOME=$2 LIBGL_ALWAYS_SOFTWARE=1
rm -f "$2/display"
Xvfb -displayfd 3 -screen 0 1400x900x24 -nolisten tcp 3> "$2/display" 2> "$2/xvfb.log" &
server=$!
trap 'kill $server' EXIT
until [ -s "$2/display" ]; do
    kill -0 $server || exit 1
    sleep 0.1
done
DISPLAY=:$(cat "$2/display")
export DISPLAY
"$kerf" view &
viewer=$!
until xdotool search --onlyvisible --name Kerf > /dev/null 2>&1; do
    kill -0 $viewer || exit 1
    sleep 0.1
done
# A key that goes down and up within one frame may be missed.
while kill -0 $viewer 2> /dev/null; do
    xdotool keydown ctrl
    sleep 0.2
    xdotool key q
    sleep 0.2
    xdotool keyup ctrl
done
wait $viewer
