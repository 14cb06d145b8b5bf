#include "files/io/text_file.h"

#include "files/io/checked_file.h"

namespace kerf {

void write_text_file(const std::string& path, std::string_view text) {
    CheckedFile file(path, "wb");
    file.write(text);
    file.close();
}

}  // namespace kerf
