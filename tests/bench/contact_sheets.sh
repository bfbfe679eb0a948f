#!/usr/bin/env bash
# Dresses bodies of the external test data in drawn garments of every kind, each in the size that its chart names for
# the body, and lays the pictures out: one sheet a kind, a column a body, from the front, the side and the back.
#   tests/bench/contact_sheets.sh BUILD DATA OUT [BODY ...]
# BUILD: the build's folder (build/release); DATA: the external test data; OUT: where sheets and fits go.
# BODY: names in DATA/bodies/population (default: twelve, spread evenly). Needs `montage` (Debian: imagemagick).
set -euo pipefail
build=$1 data=$2 out=$3
shift 3
command -v montage >/dev/null || { echo "contact_sheets: montage is missing; apt-get install imagemagick" >&2; exit 2; }
bodies=("$@")
if ((${#bodies[@]} == 0)); then
  mapfile -t all < <(cd "$data/bodies/population" && printf '%s\n' *.ply | sed 's/\.ply$//' | sort)
  for ((i = 0; i < 12; ++i)); do bodies+=("${all[i * ${#all[@]} / 12]}"); done
fi
mkdir -p "$out/garments" "$out/photographs"
kinds=(tshirt long_sleeve one_piece one_piece_sleeved skirt pants shorts)
for kind in "${kinds[@]}"; do
  photographs=$out/photographs/$kind
  "$build/bin/shop_catalog" synthesize --kind "$kind" --size 12 --out "$photographs" >/dev/null
  chart=$(tr -d ' \n' <"$photographs/chart.json")
  length=$(grep -oE '"name":"12","measures_cm":\{[^}]*"(front_)?length":[0-9.]+' <<<"$chart" | grep -oE '[0-9.]+$')
  fabric=$(grep -oE '"fabric":"[a-z]+"' <<<"$chart" | cut -d '"' -f 4)
  "$build/bin/shop_catalog" extract "$photographs/front.png" "$photographs/back.png" --kind "$kind" \
    --annotation "$photographs/truth.json" --chart "$photographs/chart.json" --length-cm "$length" \
    --fabric "$fabric" --id "${kind//_/-}" --out "$out/garments/$kind" >/dev/null
done

# An outfit: its name, then its garments, the innermost first.
outfits=("${kinds[@]}" "pants+tshirt" "tshirt+pants" "pants+tshirt+one_piece")
for outfit in "${outfits[@]}"; do
  garments=()
  for kind in ${outfit//+/ }; do garments+=(--garment "$out/garments/$kind"); done
  for body in "${bodies[@]}"; do
    fit=$out/$outfit/$body
    mkdir -p "$fit"
    if "$build/bin/fit_client" fit --scan "$data/bodies/population/$body.ply" "${garments[@]}" --size auto --no-model \
      --out "$fit" >"$fit/fit.txt" 2>&1; then
      grep -E '^Result' "$fit/fit.txt" | sed "s/^/$outfit $body: /"
    else
      echo "$outfit $body: $(tail -n 1 "$fit/fit.txt")"
    fi
  done
  pictures=()
  for view in front side back; do
    for body in "${bodies[@]}"; do
      picture=$out/$outfit/$body/$view.png
      [[ -e $picture ]] || picture=xc:gray
      pictures+=("$picture")
    done
  done
  montage "${pictures[@]}" -tile "${#bodies[@]}x3" -geometry 320x480+2+2 "$out/$outfit.png"
done
echo "sheets: $out/*.png"
