#!/usr/bin/env bash
# Some files of a library for each element of a Slurm job array; one that is lost and queued again goes on from there.
#
#     koebe batch LIBRARY --output RESULTS --list >files.txt
#     sbatch --array=1-$(wc -l <files.txt) slurm_array.sh files.txt RESULTS [options of koebe batch]
#
# For small meshes, as Slurm takes a second or two for each element: FILES=20, and a twentieth of the elements.
#
#     koebe batch LIBRARY --output RESULTS [the same options]      # afterwards: what is missing, and the table
#
# With --exit-zero a mesh that cannot be mapped is a row of the table, and an element fails only where the machine did.
#SBATCH --job-name=koebe
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail

files=$1
results=$2
shift 2
last=$((SLURM_ARRAY_TASK_ID * ${FILES:-1}))
code=0
while IFS=$'\t' read -r folder name; do
    "${KOEBE:-koebe}" batch "$folder/$name" --base "$folder" --output "$results" --workers 1 --no-summary --exit-zero \
        "$@" </dev/null || code=$?
done < <(sed -n "$((last - ${FILES:-1} + 1)),${last}p" "$files")
exit $code
