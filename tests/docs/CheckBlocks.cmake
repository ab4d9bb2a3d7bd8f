# cmake -DALL=pages -DC=pages -DCPP=pages -DJSON=pages -DSH=pages -DPYTHON=pages -DCMAKE=pages -P CheckBlocks.cmake
# Every block of code in any page is one that some test here compiles or runs.
cmake_minimum_required(VERSION 3.25)
set(tested_c "${C}")
set(tested_cpp "${CPP}")
set(tested_json "${JSON}")
set(tested_sh "${SH}")
set(tested_python "${PYTHON}")
set(tested_cmake "${CMAKE}")  # by abi.installed_sdk
foreach(page IN LISTS ALL)
  file(STRINGS "${page}" fences REGEX "^```[a-z]")
  foreach(fence IN LISTS fences)
    string(REGEX REPLACE "^```([a-z]+).*" "\\1" language "${fence}")
    if(NOT page IN_LIST tested_${language})
      message(SEND_ERROR "${page}: a block `${fence}` that nothing tests; add the page to tests/docs/CMakeLists.txt")
    endif()
  endforeach()
endforeach()
