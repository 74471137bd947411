#!/usr/bin/env bash
# Opens the viewer; without a display it draws the contact sheet instead and says where it is.
set -euo pipefail

londra() {
    cargo run --release --quiet -- "$@"
}

cargo build --release

# Exit code 3: no display or no graphics adapter.
status=0
londra view || status=$?
[ "$status" -eq 3 ] || exit "$status"

sheet="$PWD/londra-sheet.png"
echo "Drawing a contact sheet of ten breeds instead; a software driver takes a minute."
londra sheet --breeds basset,borzoi,bulldog,chihuahua,dobermann,german_shepherd,labrador,papillon,pug,wolf -o "$sheet"
echo "The contact sheet is $sheet"
