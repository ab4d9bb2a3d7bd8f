# Sourced: what an archive needs that runs on machines with other libraries, or none. The caller has set -euo pipefail.

# Loaded by name when OpenGL is first asked for.
dispatch=(libEGL.so.1 libGL.so.1 libOpenGL.so.0 libGLX.so.0 libGLdispatch.so.0)

needed() { # FILE...: libraries that they load, as paths
  ldd "$@" | awk '$2 == "=>" && $3 ~ /^\// {print $3} $1 ~ /^\/.*ld-linux/ {print $1}' | sort -u
}

# Copies every library that the files load but Brume's own and a driver's into KIT/lib, and into KIT/runtime those of C and C++.
# Says whence.
collect_libraries() { # KIT FILE...
  local kit=$1 found library to; shift
  mkdir -p "$kit"/lib "$kit"/runtime/{c,c++}
  found=$(for name in "${dispatch[@]}"; do ldconfig -p | awk -v name="$name" '$1 == name && /x86-64/ {print $NF; exit}'; done)
  for library in $found $(needed "$@" $found); do
    case $(basename "$library") in
      libbrume.so.*) continue ;;
      # A driver may need newer ones than these: they are taken only where the machine's do not serve.
      libstdc++.so.*|libgcc_s.so.*) to=runtime/c++ ;;
      ld-linux*|libc.so.*|libm.so.*|libdl.so.*|libpthread.so.*|librt.so.*) to=runtime/c ;;
      *) to=lib ;;
    esac
    cp -L "$library" "$kit/$to/"
    echo "$library"
  done
}
