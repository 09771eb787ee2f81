#!/bin/bash
# {{name}}: {{frames}} frames in {{shards}} shards. Submit from this folder: sbatch THIS_FILE
# Submitted again, after whatever happened, it goes on where it stopped. Ask how far it is: ensonify status {{dir}}
#SBATCH --job-name={{job}}
#SBATCH --array=0-{{last}}
#SBATCH --cpus-per-task={{cpus}}
#SBATCH --mem={{memory}}
#SBATCH --time={{time}}
#SBATCH --output={{job}}-%A_%a.log
# A task whose node fails, or that has to make room, starts again and keeps its frames.
#SBATCH --requeue
#SBATCH --open-mode=append
# A minute before the time is up, and where the cluster preempts with a signal, the task is told: it ends in order.
#SBATCH --signal=B:TERM@60
set -euo pipefail
ensonify="${ENSONIFY:-ensonify}"

# The first task, on its first start, asks for the finishing. Any end of the others will do (afterany): after a shard that
# failed, `afterok` would wait for ever, and finishing tells which frames are missing.
if [ "$SLURM_ARRAY_TASK_ID" = 0 ] && [ "${SLURM_RESTART_COUNT:-0}" = 0 ]; then
  sbatch --job-name={{job}}-finish --dependency="afterany:$SLURM_ARRAY_JOB_ID" --output={{job}}-finish-%j.log \
    --time={{time}} --mem={{memory}} --wrap="exec '$ensonify' finish {{dir}}"
fi

# Told to stop, a task hands the signal on, waits for the frames in work and queues itself again.
told=no
trap 'told=yes; kill -TERM "$run" 2>/dev/null' TERM
( exec "$ensonify" run {{recipe}} -o {{dir}}{{sets}} --shard "$SLURM_ARRAY_TASK_ID/{{shards}}" --jobs "${SLURM_CPUS_PER_TASK:-1}" ) &
run=$!
code=0
wait "$run" || code=$?
# A trap ends `wait` early; the run itself ends a little later.
if [ "$told" = yes ]; then code=0; wait "$run" || code=$?; fi
if [ "$code" = 75 ] && [ "$told" = yes ]; then
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_${SLURM_ARRAY_TASK_ID}" && sleep 60
fi
exit "$code"
