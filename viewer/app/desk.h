// The desk beside the scene: pictures that are saved, notices, the clipboard, and the wish to quit.
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
    /// Saves the picture that was wanted, with its view as JSON beside it, and notes either success or the error.
    void save_picture(const Image& picture);
    /// Takes the notice away: a message after some seconds, an error by a click.
    void clear_notice();

 private:
    ViewOrigin origin_of_picture() const;

    View& view_;
    bool quit_ = false, capture_ = false;
};

}  // namespace kerf::view
