# embed_files(<file>.cpp <folder> <name>...): files of a folder as constants of C++, each named like its file with _ for
# other characters. Written while CMake configures, so that whoever reads the sources without a build finds it.
function(embed_files output folder)
  string(CONCAT source "// Longer texts than the standard promises, but all compilers of ours take them.\n"
    "#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n#include \"files/html/inside/page_files.h\"\n"
    "\nnamespace kerf::page_files {\n")
  foreach(file ${ARGN})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/${file})
    file(READ ${folder}/${file} content)
    string(MAKE_C_IDENTIFIER ${file} name)
    string(APPEND source "\nextern const std::string_view ${name};\n"
      "const std::string_view ${name} = R\"kerf!(${content})kerf!\";\n")
  endforeach()
  string(APPEND source "\n}  // namespace kerf::page_files\n")
  set(before)
  if(EXISTS ${output})
    file(READ ${output} before)
  endif()
  if(NOT before STREQUAL source)  # else what is built stays
    file(WRITE ${output} "${source}")
  endif()
endfunction()
