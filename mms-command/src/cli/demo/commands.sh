# Builds the solver, runs it on three meshes, judges the results and asks what is wrong with them. It needs the Rust compiler and
# `mms`. Break a line of solver.rs, and run it again: `sh commands.sh`
cd "$(dirname "$0")"
rustc --edition 2021 -O main.rs -o demo || exit
mkdir -p mine
for cells in 4 8 12; do ./demo $cells > mine/$cells.csv; done
mms judge sheared_block_2d mine/4.csv mine/8.csv mine/12.csv
mms diagnose sheared_block_2d mine/4.csv mine/8.csv mine/12.csv

# The results of the demo itself:
#   mms judge sheared_block_2d right/4.csv right/8.csv right/12.csv
#   mms judge sheared_block_2d broken/4.csv broken/8.csv broken/12.csv
#   mms diagnose sheared_block_2d broken/4.csv broken/8.csv broken/12.csv
