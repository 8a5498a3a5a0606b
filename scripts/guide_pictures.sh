#!/usr/bin/env bash
# The pages' pictures.
# Usage: scripts/guide_pictures.sh window     cut out of those that `make test-gui` leaves in out/gui
#        scripts/guide_pictures.sh film       the film at the top, filmed in a window on a screen of its own
#        scripts/guide_pictures.sh plotted    drawn by matplotlib, beside the packages of `make test-labs`
#        scripts/guide_pictures.sh drawn      drawn by Blender: the vase in its pattern, hand and character in parts, a torus tile, a sphere
set -euo pipefail
cd "$(dirname "$0")/.."
images=docs/images

cut() { # NAME PICTURE WIDTHxHEIGHT+X+Y WIDTH
    convert "out/gui/$2.png" -crop "$3" +repage -resize "$4x" -quality 85 "$images/guide_$1.jpg"
}
draw() { # SAMPLE SCRIPT its options
    blender --background "blend_samples/$1.blend" --factory-startup --python-exit-code 1 --python "scripts/$2" -- "${@:3}" >/dev/null
}

case $1 in
window)
    cut panel 01_panel 1057x692+0+28 800
    cut distortion 08_area 1057x692+0+28 800
    cut uv_editor 11_loop_selected 1057x641+0+28 800
    cut filled 12_filled 1057x641+0+28 800
    cut circles 44_disk_held_OBJECT 1057x772+0+28 800
    cut flat 51_flat_copy 588x420+225+178 560
    cut lift 70_lift 1057x692+0+28 800
    cut scatter 71_scatter 466x520+362+126 480
    cut trims 93_in_the_trims 330x330+105+265 420
    cut loops 72_loops 460x330+300+290 460
    # without the row that names the folder of the tests
    convert out/gui/15_preferences.png -crop 884x340+170+61 +repage -gravity North -chop 0x23+0+126 +repage \
        -strip "$images/guide_install.png"
    ;;
film)
    PATH=/usr/bin:$PATH xvfb-run -a -s '-screen 0 880x560x24' /usr/bin/python3 scripts/guide_film.py "$images/guide_film.gif"
    PATH=/usr/bin:$PATH xvfb-run -a -s '-screen 0 880x560x24' /usr/bin/python3 scripts/guide_film.py "$images/guide_live.gif" live
    ;;
drawn)
    draw vase guide_picture.py "$images/guide_vase.jpg"
    draw hand parts_picture.py --output "$images/guide_parts_hand.jpg" --size 1000x500
    draw character parts_picture.py --output "$images/parts_character.jpg" --size 1000x500
    draw closed_head parts_picture.py --output "$images/importance_before.jpg" --size 1000x500
    draw closed_head parts_picture.py --output "$images/importance_after.jpg" --size 1000x500 \
        --important 0.5,0.0,0.45,0.35
    draw mug tile_picture.py "$images/guide_tile.jpg"  # which takes nothing of the file
    draw closed_head sphere_picture.py "$images/guide_sphere.jpg"
    ;;
plotted)
    for name in fit formats landmark noise teichmueller template_image; do
        PYTHONPATH=build/python build/venv-labs/bin/python "scripts/${name}_picture.py"
    done
    ;;
*)
    echo "window, film, drawn or plotted" >&2
    exit 2
    ;;
esac
