# meshlab::sdk: what a plugin of a MeshLab release compiles and links with: the headers of
# MESHLAB_SOURCE_DIR, the libmeshlab-common that is installed, Qt 5 and OpenGL. The two must be of
# the same release; the source tree says which (MESHLAB_RELEASE), and so which adapter is built.

file(STRINGS "${MESHLAB_SOURCE_DIR}/ML_VERSION" release LIMIT_COUNT 1)
set(MESHLAB_RELEASE "${release}" CACHE INTERNAL "Release of the MeshLab sources")

function(require_for_plugin found what debian_packages)
  if(NOT ${found})
    message(FATAL_ERROR
            "The MeshLab plugin needs ${what}. On Debian: apt-get install ${debian_packages}. "
            "Or leave the plugin out: -DTRACKED_MCF_PLUGIN=OFF.")
  endif()
endfunction()

find_path(MESHLAB_GLEW_INCLUDE_DIR GL/glew.h)
find_path(MESHLAB_GLU_INCLUDE_DIR GL/glu.h)
require_for_plugin(MESHLAB_GLEW_INCLUDE_DIR "the header GL/glew.h" libglew-dev)
require_for_plugin(MESHLAB_GLU_INCLUDE_DIR "the header GL/glu.h" libglu1-mesa-dev)

find_library(MESHLAB_COMMON_LIBRARY meshlab-common PATH_SUFFIXES meshlab)
require_for_plugin(MESHLAB_COMMON_LIBRARY "the installed library libmeshlab-common" meshlab)
get_filename_component(library_dir "${MESHLAB_COMMON_LIBRARY}" DIRECTORY)
set(MESHLAB_PLUGIN_DIR "${library_dir}/plugins"
    CACHE PATH "Where MeshLab looks for plugins, and cmake --install puts ours")

add_library(meshlab_sdk INTERFACE)
add_library(meshlab::sdk ALIAS meshlab_sdk)
target_include_directories(
  meshlab_sdk SYSTEM INTERFACE "${MESHLAB_SOURCE_DIR}/src" "${VCGLIB_INCLUDE_DIR}"
                               "${MESHLAB_GLEW_INCLUDE_DIR}" "${MESHLAB_GLU_INCLUDE_DIR}")
target_link_libraries(meshlab_sdk INTERFACE "${MESHLAB_COMMON_LIBRARY}" Eigen3::Eigen)

if(MESHLAB_RELEASE VERSION_EQUAL 2020.09)
  set(qt_modules Core Gui Widgets OpenGL Xml)
  find_package(Qt5 QUIET COMPONENTS ${qt_modules})
  require_for_plugin(Qt5_FOUND "Qt 5 with its OpenGL module" "qtbase5-dev libqt5opengl5-dev")
  target_compile_definitions(meshlab_sdk INTERFACE MESHLAB_SCALAR=float)
else()
  message(FATAL_ERROR
          "MESHLAB_SOURCE_DIR holds MeshLab ${MESHLAB_RELEASE}, for which there is no adapter: "
          "the plugin is for MeshLab 2020.09.")
endif()

# Targets that find_package imports are visible in this folder only, unless promoted.
set_target_properties(Qt5::moc PROPERTIES IMPORTED_GLOBAL TRUE)
foreach(module IN LISTS qt_modules)
  set_target_properties(Qt5::${module} PROPERTIES IMPORTED_GLOBAL TRUE)
  target_link_libraries(meshlab_sdk INTERFACE Qt5::${module})
endforeach()
