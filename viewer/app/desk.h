// What lies beside the scene: pictures that are kept, notices, the clipboard, and the wish to quit.
#pragma once

#include <string>

#include "viewer/app/view.h"

namespace kerf::view {

class Desk : public WindowActions {
 public:
    explicit Desk(View& view) : view_(view) {}

    void quit() override { quit_ = true; }
    void take_screenshot() override { capture_ = true; }
    void copy(const std::string& text) override;
    std::string clipboard() override;
    void complain(const std::string& text) override;

    bool wants_to_quit() const { return quit_; }
    bool wants_picture() const { return capture_; }
    /// That was wanted, with its view beside it; what fails is a notice.
    void save_picture(const Image& picture);
    /// Takes away what was read: a notice after some seconds, an error by a click.
    void clear_notice();

 private:
    ViewOrigin origin_of_picture() const;

    View& view_;
    bool quit_ = false, capture_ = false;
};

}  // namespace kerf::view
