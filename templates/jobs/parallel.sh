#!/bin/sh
# {{name}}: {{frames}} frames in {{shards}} shards, {{cpus}} threads each, on this machine or with --sshlogin on several that
# share this folder. Run again, it goes on where it stopped.
set -eu
ensonify="${ENSONIFY:-ensonify}"
parallel --quote --jobs "${PARALLEL_JOBS:-2}" --retries 2 --joblog {{joblog}} --termseq TERM,5000,KILL \
  "$ensonify" run {{recipe}} -o {{dir}}{{sets}} --shard '{}/{{shards}}' --jobs {{cpus}} ::: $(seq 0 {{last}})
exec "$ensonify" finish {{dir}}
