#!/bin/sh
# run.sh [--tests]: the GL tests' verdict, how far this machine's GPU is from the CPU at worst, and tables of times, also in the
# folder results. --tests: without the tables. No package is needed, only a driver with OpenGL 4.5 through EGL.
cd "$(dirname "$0")" || exit 2
kit=$(pwd)
mkdir -p results
start=$(date +%s)
failed=""

# The machine's own C and C++ libraries where these programs run with them, since its driver was made for them; else the kit's.
here="$kit/lib"
loader=""
run() { # SECONDS PROGRAM ARGUMENT...
  seconds=$1 program=$2; shift 2
  timeout "$seconds" env LD_LIBRARY_PATH="$here" $loader "$kit/bin/$program" "$@"
}
runs() { run 20 gl_tests --gtest_list_tests >/dev/null 2>&1; }
if ! runs; then
  here="$here:$kit/runtime/c++"
  if ! runs; then
    here="$here:$kit/runtime/c:/usr/lib/x86_64-linux-gnu:/lib/x86_64-linux-gnu:/usr/lib64:/lib64:/usr/lib"
    loader="$kit/runtime/c/ld-linux-x86-64.so.2"
    runs || { echo "programs do not start here:"; run 10 gl_tests --gtest_list_tests; exit 1; }
  fi
fi
# Where containers put what would say which driver there is.
if [ -z "$__EGL_VENDOR_LIBRARY_FILENAMES" ] && ! ls /usr/share/glvnd/egl_vendor.d/*.json /etc/glvnd/egl_vendor.d/*.json >/dev/null 2>&1; then
  for vendor in /usr/local/*/share/glvnd/egl_vendor.d/*.json /opt/*/share/glvnd/egl_vendor.d/*.json; do
    [ -f "$vendor" ] && export __EGL_VENDOR_LIBRARY_FILENAMES="$vendor" && break
  done
fi

tested() { # NAME SECONDS PROGRAM ARGUMENT...
  name=$1; shift
  if run "$@" --gtest_brief=1 >"results/$name.txt" 2>&1; then verdict=passed; else verdict="FAILED (status $?; 124: out of time)"; failed="$failed $name"; fi
  echo "$name: $verdict; $(grep -E '^\[==========\]' "results/$name.txt" | tail -n 1 | cut -c 14-)"
  grep -E '^\[  (FAILED|SKIPPED) \]|Failure$' "results/$name.txt" | sort -u | head -n 20
}

echo "== tests"
# One of them holds a page of the documentation against the code.
tested gl_tests 90 gl_tests --gtest_filter='-*Document*'
tested gl_abi_tests 60 gl_abi_tests
tested gpu_against_cpu 150 effect_tests --gtest_filter='*Gpu*:Surface.BackendsAgree:Reference.*Gl*'
echo "== GPU against CPU"
grep -h 'worst' results/gpu_against_cpu.txt
if [ "$1" != --tests ]; then
  for bench in filter airlight; do
    left=$((470 - $(date +%s) + start))
    echo "== times: $bench"
    if [ $left -lt 1 ] || ! run $left ${bench}_bench --quick results/$bench.json results/$bench.md >results/$bench.txt 2>&1; then
      tail -n 5 results/$bench.txt
      failed="$failed ${bench}_bench"
    fi
    cat results/$bench.md
  done
fi
echo "== $(($(date +%s) - start)) s"
[ -z "$failed" ] || { echo "failed:$failed"; exit 1; }
