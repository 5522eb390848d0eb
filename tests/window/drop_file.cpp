// Drops a file onto a window, as a file manager does (XDND, version 5).
// Usage: drop_file WINDOW FILE, with the number that xdotool gives a window
#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

class Source {
  public:
    Source(Display* display, Window target, std::string text)
        : display_(display),
          target_(target),
          own_(XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0)),
          text_(std::move(text)) {
        XSetSelectionOwner(display_, atom("XdndSelection"), own_, CurrentTime);
    }

    void drop() {
        send("XdndEnter", 5L << 24, static_cast<long>(atom("text/uri-list")), 0, 0);
        send("XdndPosition", 0, 0, CurrentTime, static_cast<long>(atom("XdndActionCopy")));
        wait_for("XdndStatus");
        send("XdndDrop", 0, CurrentTime, 0, 0);
        wait_for("XdndFinished");
    }

  private:
    Atom atom(const char* name) { return XInternAtom(display_, name, False); }

    void send(const char* what, long a, long b, long c, long d) {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = target_;
        event.xclient.message_type = atom(what);
        event.xclient.format = 32;
        const long data[] = {static_cast<long>(own_), a, b, c, d};
        for (int i = 0; i < 5; ++i) event.xclient.data.l[i] = data[i];
        XSendEvent(display_, target_, False, NoEventMask, &event);
        XFlush(display_);
    }

    // Gives the text to whoever asks meanwhile.
    void wait_for(const char* what) {
        while (true) {
            XEvent event;
            XNextEvent(display_, &event);
            if (event.type == SelectionRequest) give(event.xselectionrequest);
            const bool is_message = event.type == ClientMessage;
            if (is_message && event.xclient.message_type == atom(what)) return;
        }
    }

    void give(const XSelectionRequestEvent& request) {
        XChangeProperty(display_, request.requestor, request.property, request.target, 8,
                        PropModeReplace, reinterpret_cast<const unsigned char*>(text_.data()),
                        static_cast<int>(text_.size()));
        XEvent answer{};
        answer.xselection.type = SelectionNotify;
        answer.xselection.requestor = request.requestor;
        answer.xselection.selection = request.selection;
        answer.xselection.target = request.target;
        answer.xselection.property = request.property;
        answer.xselection.time = request.time;
        XSendEvent(display_, request.requestor, False, NoEventMask, &answer);
        XFlush(display_);
    }

    Display* display_;
    Window target_, own_;
    std::string text_;
};

}  // namespace

int main(int argc, char** argv) {
    Display* const display = argc == 3 ? XOpenDisplay(nullptr) : nullptr;
    if (!display) {
        std::fprintf(stderr, "usage: drop_file WINDOW FILE, with a screen\n");
        return 2;
    }
    const Window target = std::strtoul(argv[1], nullptr, 0);
    const std::string path = std::filesystem::absolute(argv[2]).string();
    Source(display, target, "file://" + path + "\r\n").drop();
    XCloseDisplay(display);
    return 0;
}
