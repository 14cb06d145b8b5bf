# cmake -DFOLDER=... -DOUTPUT=FILE.cpp -DFILES=NAME,... -P embed.cmake: files of a folder as constants of C++, each
# named like its file with _ for other characters.
set(source "#include \"html/page_files.h\"\n\nnamespace kerf::page_files {\n")
string(REPLACE "," ";" files "${FILES}")
foreach(file ${files})
  file(READ ${FOLDER}/${file} content)
  string(MAKE_C_IDENTIFIER ${file} name)
  string(APPEND source "\nextern const std::string_view ${name};\n"
    "const std::string_view ${name} = R\"kerf!(${content})kerf!\";\n")
endforeach()
file(WRITE ${OUTPUT} "${source}\n}  // namespace kerf::page_files\n")
