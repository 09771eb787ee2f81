#!/usr/bin/env bash
# The other printed scripts: the Kubernetes manifest against the schema of Kubernetes, GNU parallel and Snakemake for real.
# Usage: tests/engines/others.sh ENSONIFY PYTHON_VENV
set -euo pipefail
here=$(cd "$(dirname "$0")/../.." && pwd)
export ENSONIFY; ENSONIFY=$(realpath "$1")
bin=$(realpath "$2")/bin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
say() { printf -- '-- %s\n' "$*"; }
hash() { sed -n 's/.*"dataset_hash": "\(.*\)",/\1/p' "$1/manifest.json"; }

if ! command -v parallel >/dev/null; then
  apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends parallel >/dev/null
fi
"$bin/pip" install --quiet --disable-pip-version-check kubernetes-validate==1.31.0 snakemake==9.27.0

cd "$work"
cp "$here/tests/engines/recipe.yaml" .
ln -s "$here/catalogs" catalogs
less=(--set scenes=8 --set frames=3)
"$ENSONIFY" run recipe.yaml "${less[@]}" -o alone >/dev/null 2>&1

say "Kubernetes"
"$ENSONIFY" job k8s recipe.yaml --shards 4 --set water.depth_m=20 --set 'seabed.sediment={choice: [silt, gravel]}' --image registry/ensonify:1 > job.yaml
"$bin/kubernetes-validate" -k 1.31 --strict job.yaml

say "GNU parallel"
"$ENSONIFY" job parallel recipe.yaml "${less[@]}" --shards 3 --cpus 1 -o "with parallel" > job.sh
sh job.sh >/dev/null 2>&1 </dev/null || { cat "with parallel.joblog"; exit 1; }
[ "$(hash "with parallel")" = "$(hash alone)" ] || { say "FAILED: another hash"; exit 1; }

say "Snakemake"
"$ENSONIFY" job snakemake recipe.yaml "${less[@]}" --shards 3 --cpus 1 -o "with snakemake" > Snakefile
"$bin/snakemake" --cores 2 --quiet all >snakemake.log 2>&1 || { cat snakemake.log; exit 1; }
[ "$(hash "with snakemake")" = "$(hash alone)" ] || { say "FAILED: another hash"; exit 1; }
say "all three make the dataset of one process"
