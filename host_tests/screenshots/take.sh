#!/usr/bin/env bash
# Pictures of what taut shows, for README.md: take.sh TAUT DATA FOLDER. Needs Chromium and pdftoppm.
set -euo pipefail
taut=$1 data=$2 folder=$3
work=$(mktemp -d)
watched=
finish() {
  if [[ -n $watched ]]; then kill "$watched" 2> /dev/null || true; fi
  rm -rf "$work"
}
trap finish EXIT
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
browse() { "$chromium" --headless --no-sandbox --disable-gpu --hide-scrollbars --user-data-dir="$work/profile" "$@" > "$work/said" 2>&1; }

mkdir -p "$folder"
cd "$data"
"$taut" report rigid_saddles.json rigid_saddles_site.csv --job rigid_saddles_job.json --goal rigid_saddles_goal.json \
  -o "$work/record.html" 2> "$work/remarks"
browse --no-pdf-header-footer --print-to-pdf="$work/record.pdf" "file://$work/record.html"
pdftoppm -r 96 -png -f 1 -l 1 -singlefile "$work/record.pdf" "$folder/record"
# What comes after page one, on a screen.
perl -0pe 's#<section class="record">.*?</section>##s' "$work/record.html" > "$work/run.html"
for look in light dark; do
  browse $([[ $look == dark ]] && echo --force-dark-mode) --window-size=820,1000 --screenshot="$folder/report_$look.png" \
    "file://$work/run.html"
done

"$taut" plan plan_string.json plan_string_goal.json --report "$work/plan.html" > "$work/plan"
browse --no-pdf-header-footer --print-to-pdf="$work/plan.pdf" "file://$work/plan.html"
pdftoppm -r 96 -png -f 1 -l 1 -singlefile "$work/plan.pdf" "$folder/plan"

# The log is at its end at once, and the page stays there.
"$taut" watch rigid_saddles.json rigid_saddles_site.csv --http 0 2> "$work/url" > "$work/terminal" &
watched=$!
for _ in $(seq 100); do
  if grep -q http "$work/url" && [[ $(curl -s "$(grep -o 'http://[^ ]*' "$work/url" | head -1)/answer.json") == *segments* ]]; then break; fi
  sleep 0.1
done
sleep 1
url=$(grep -o 'http://[^ ]*' "$work/url" | head -1)
for look in light dark; do
  browse $([[ $look == dark ]] && echo --force-dark-mode) --window-size=390,844 --screenshot="$folder/watch_$look.png" "$url"
done
