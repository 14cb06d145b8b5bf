// The desk beside the scene: pictures that are saved, notices, the clipboard, and the wish to quit.
#pragma once

#include <set>
#include <string>
#include <utility>

#include "viewer/app/unsaved.h"

namespace kerf::view {

class Desk : public WindowActions {
 public:
    Desk(View& view, Unsaved& unsaved) : view_(view), unsaved_(unsaved) {}

    void quit() override;
    void take_screenshot() override;
    void save_picture(const std::string& path) override { picture_ = path; }
    void answer(UnsavedFate answer) override { unsaved_.answer(answer); }
    void copy(const std::string& text) override;
    std::string clipboard() override;
    void complain(const std::string& text) override;

    /// Returns whether quit() was called, and nobody has to be asked any more.
    bool wants_to_quit() const { return quit_; }
    bool wants_picture() const { return !picture_.empty(); }
    /// Saves the picture that was wanted, with its view as JSON beside it, and notes either success or the error.
    void write_picture(const Image& picture);
    /// Notes what was saved, or why it could not be.
    void follow();
    /// Takes the notice away: a message after some seconds, an error by a click.
    void clear_notice();

 private:
    ViewOrigin origin_of_picture() const;

    View& view_;
    Unsaved& unsaved_;
    bool quit_ = false;
    std::string picture_;                                 // file of a picture that is wanted; empty: none
    std::set<std::pair<std::string, std::string>> told_;  // folders of runs, and the places of which it was told
};

}  // namespace kerf::view
