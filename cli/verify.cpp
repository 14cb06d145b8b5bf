#include "cli/verify.h"

#include "io/standard_streams.h"

namespace kerf {

int verify_run(const std::string& folder, const VerifyOptions& options) {
    const FolderVerification found = verify_folder(folder, options);
    print_data(to_text(found, folder, options));
    return found.exit_code();
}

}  // namespace kerf
