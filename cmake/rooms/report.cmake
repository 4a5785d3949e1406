# JSON is written, and zlib and the page's script are needed, inside the room only.
find_package(ZLIB REQUIRED)
find_package(nlohmann_json REQUIRED)
target_link_libraries(tilth_report PRIVATE nlohmann_json::nlohmann_json ZLIB::ZLIB)

# The scripts of report.html and of the live view are bundled where scripts/setup got its libraries, and come with a source distribution of the
# Python package (scripts/wheels); else empty files stand in for them.
set(web ${PROJECT_SOURCE_DIR}/web)
set(web_build ${PROJECT_BINARY_DIR}/web)
set(web_names report.js report.css report.sha256 view.js view.css view.sha256)
list(TRANSFORM web_names PREPEND ${web_build}/ OUTPUT_VARIABLE web_files)
find_program(TILTH_NODE node)
if(TILTH_NODE AND EXISTS ${web}/node_modules/esbuild)
  set(TILTH_WEB_BUNDLE ON)
  file(GLOB_RECURSE web_sources CONFIGURE_DEPENDS ${web}/src/*)
  add_custom_command(
    OUTPUT ${web_files}
    COMMAND ${TILTH_NODE} ${web}/build.mjs ${web_build}
    DEPENDS ${web_sources} ${web}/build.mjs ${web}/package-lock.json
    COMMENT "Bundling the scripts of report.html and of the live view")
elseif(EXISTS ${web}/bundle/report.js)
  set(TILTH_WEB_BUNDLE ON)
  set(web_build ${web}/bundle)
  list(TRANSFORM web_names PREPEND ${web_build}/ OUTPUT_VARIABLE web_files)
else()
  set(TILTH_WEB_BUNDLE OFF)
  message(STATUS "report.html will have no 3D view: the libraries of web/package.json are not there (scripts/setup)")
  file(MAKE_DIRECTORY ${web_build})
  add_custom_command(OUTPUT ${web_files} COMMAND ${CMAKE_COMMAND} -E touch ${web_files})
  foreach(file IN LISTS web_files)
    file(WRITE ${file} "")
  endforeach()
endif()
set_source_files_properties(
  ${PROJECT_SOURCE_DIR}/tilth/report/web_bundle.cpp
  PROPERTIES OBJECT_DEPENDS "${web_files};${web}/src/report.css" COMPILE_DEFINITIONS
             "TILTH_WEB_SOURCE=\"${web}/src\";TILTH_WEB_BUILD=\"${web_build}\"")
target_compile_options(tilth_report PRIVATE ${TILTH_QUICKLY_COMPILED})
