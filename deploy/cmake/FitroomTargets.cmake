# How every target of the project is declared: one set of flags, sources listed by hand.

# Warnings are for our code only; dependencies are included as SYSTEM.
add_library(fitroom_flags INTERFACE)
target_include_directories(fitroom_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(fitroom_flags INTERFACE -Wall -Wextra -Wshadow -Wconversion -ffp-contract=off)
if(FITROOM_WERROR)
  target_compile_options(fitroom_flags INTERFACE -Werror)
endif()
if(FITROOM_SANITIZE)
  target_compile_options(fitroom_flags INTERFACE -fsanitize=${FITROOM_SANITIZE} -fno-sanitize-recover=all
                                                 -fno-omit-frame-pointer)
  target_link_options(fitroom_flags INTERFACE -fsanitize=${FITROOM_SANITIZE})
  if(FITROOM_SANITIZE_SKIP)
    target_compile_options(fitroom_flags INTERFACE -fno-sanitize=${FITROOM_SANITIZE_SKIP})
  endif()
endif()
if(FITROOM_COVERAGE)
  target_compile_options(fitroom_flags INTERFACE --coverage)
  target_link_options(fitroom_flags INTERFACE --coverage)
endif()

# A compiler cache halves rebuilds where one is installed; it is never required.
find_program(FITROOM_CCACHE ccache)
if(FITROOM_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${FITROOM_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${FITROOM_CCACHE})
endif()

# The headers that take the longest to read, read once. Tests always do so. Rooms do so only in builds that have no
# other purpose than to run all tests: elsewhere a file that forgets an include is found by the compiler, there by the
# test of the house rules, which knows this list.
set(fitroom_precompiled_headers <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <optional> <span>
                                <string> <string_view> <vector> <Eigen/Core> <Eigen/Geometry>)
set(fitroom_precompiled_rpc_headers ${fitroom_precompiled_headers} <grpcpp/grpcpp.h>)

# A target that does nothing but read `headers` for others. What it is linked with, and whether it is an executable,
# decide how they are compiled: both must be as in the targets that use them.
function(fitroom_precompile name)
  cmake_parse_arguments(arg "EXECUTABLE" "" "HEADERS;LIBRARIES" ${ARGN})
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${name}.cc CONTENT "int main() { return 0; }\n")
  if(arg_EXECUTABLE)
    add_executable(${name} ${PROJECT_BINARY_DIR}/${name}.cc)
  else()
    add_library(${name} STATIC ${PROJECT_BINARY_DIR}/${name}.cc)
  endif()
  target_link_libraries(${name} PRIVATE fitroom_flags Eigen3::Eigen ${arg_LIBRARIES})
  target_precompile_headers(${name} PRIVATE ${arg_HEADERS})
endfunction()

# Says in `result` whether what links `libraries` uses gRPC and is therefore compiled with it.
function(fitroom_uses_rpc result libraries)
  if("${libraries}" MATCHES "gRPC|_(rpc|proto|remote|service|transfer)(;|$)")
    set(${result} ON PARENT_SCOPE)
  else()
    set(${result} OFF PARENT_SCOPE)
  endif()
endfunction()

if(FITROOM_PRECOMPILE)
  # What links gRPC is compiled with -pthread; headers serve only files that are compiled alike.
  target_compile_options(fitroom_flags INTERFACE -pthread)
  # From a precompiled header the optimiser's guesses about the inside of the standard library are no longer hidden.
  target_compile_options(fitroom_flags INTERFACE -Wno-error=array-bounds -Wno-error=dangling-pointer
                                                 -Wno-error=free-nonheap-object -Wno-error=maybe-uninitialized
                                                 -Wno-error=nonnull -Wno-error=restrict
                                                 -Wno-error=stringop-overflow -Wno-error=stringop-overread)
  fitroom_precompile(fitroom_precompiled HEADERS ${fitroom_precompiled_headers})
  if(FITROOM_WITH_RPC)
    fitroom_precompile(fitroom_precompiled_rpc HEADERS ${fitroom_precompiled_rpc_headers} LIBRARIES gRPC::grpc++)
  endif()
endif()

# fitroom_add_library(NAME SOURCES a.cc b.cc PUBLIC libs PRIVATE libs)
function(fitroom_add_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  if(arg_SOURCES)
    add_library(${name} STATIC ${arg_SOURCES})
    target_link_libraries(${name} PUBLIC fitroom_flags ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
    if(FITROOM_PRECOMPILE)
      fitroom_uses_rpc(uses_rpc "${arg_PUBLIC};${arg_PRIVATE}")
      if(uses_rpc)
        target_precompile_headers(${name} REUSE_FROM fitroom_precompiled_rpc)
      else()
        target_precompile_headers(${name} REUSE_FROM fitroom_precompiled)
      endif()
    endif()
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE fitroom_flags ${arg_PUBLIC})
  endif()
endfunction()

# fitroom_add_program(NAME SOURCES main.cc PRIVATE libs)
function(fitroom_add_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;PRIVATE" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_compile_definitions(${name} PRIVATE FITROOM_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${name} PRIVATE fitroom_flags ${arg_PRIVATE})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
endfunction()
