#include "viewer/window/panel.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <filesystem>
#include <utility>

#include "viewer/window/parameter_widgets.h"

namespace lissom::window {
namespace {

constexpr double kWidth = 290.0, kConsoleHeight = 170.0;
constexpr double kTextHeight = 15.0;
// The last lines of the console are drawn.
constexpr std::size_t kShownLines = 2000;
constexpr std::size_t kLongestText = 1024;
constexpr int kFramesAfterInput = 2;

constexpr std::array kFonts{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                            "/usr/share/fonts/dejavu/DejaVuSans.ttf",
                            "/usr/share/fonts/TTF/DejaVuSans.ttf"};

void load_font(double scale) {
    ImGuiIO& io = ImGui::GetIO();
    std::error_code error;
    for (const char* path : kFonts) {
        if (!std::filesystem::exists(path, error)) continue;
        io.Fonts->AddFontFromFileTTF(path, static_cast<float>(kTextHeight * scale));
        return;
    }
    io.FontGlobalScale = static_cast<float>(scale);
}

void set_colors(bool dark) {
    ImGuiStyle& style = ImGui::GetStyle();
    if (dark) {
        ImGui::StyleColorsDark(&style);
    } else {
        ImGui::StyleColorsLight(&style);
    }
    const ImVec4 accent(0.36f, 0.52f, 0.78f, 1.0f);
    const auto faded = [&](float alpha) { return ImVec4(accent.x, accent.y, accent.z, alpha); };
    style.Colors[ImGuiCol_WindowBg] =
        dark ? ImVec4(0.125f, 0.13f, 0.145f, 1.0f) : ImVec4(0.97f, 0.97f, 0.975f, 1.0f);
    style.Colors[ImGuiCol_PopupBg] =
        dark ? ImVec4(0.16f, 0.165f, 0.185f, 1.0f) : ImVec4(1.0f, 1.0f, 1.0f, 1.0f);
    style.Colors[ImGuiCol_FrameBg] =
        dark ? ImVec4(0.21f, 0.22f, 0.245f, 1.0f) : ImVec4(0.88f, 0.885f, 0.9f, 1.0f);
    style.Colors[ImGuiCol_Header] = faded(0.30f);
    style.Colors[ImGuiCol_HeaderHovered] = faded(0.45f);
    style.Colors[ImGuiCol_HeaderActive] = faded(0.6f);
    style.Colors[ImGuiCol_Button] = faded(0.35f);
    style.Colors[ImGuiCol_ButtonHovered] = faded(0.6f);
    style.Colors[ImGuiCol_ButtonActive] = faded(0.8f);
    style.Colors[ImGuiCol_SliderGrab] = faded(0.9f);
    style.Colors[ImGuiCol_SliderGrabActive] = accent;
    style.Colors[ImGuiCol_CheckMark] = dark ? ImVec4(0.55f, 0.72f, 1.0f, 1.0f) : accent;
}

void set_sizes(double scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowRounding = 0.0f;
    style.WindowBorderSize = 0.0f;
    style.FrameRounding = 3.0f;
    style.GrabRounding = 3.0f;
    style.ItemSpacing = ImVec2(7.0f, 5.0f);
    style.WindowPadding = ImVec2(12.0f, 10.0f);
    style.ScaleAllSizes(static_cast<float>(scale));
}

ImVec4 color_of(LineKind kind, bool dark) {
    switch (kind) {
        case LineKind::error:
            return dark ? ImVec4(1.0f, 0.48f, 0.42f, 1.0f) : ImVec4(0.75f, 0.1f, 0.05f, 1.0f);
        case LineKind::warning:
            return dark ? ImVec4(0.95f, 0.78f, 0.4f, 1.0f) : ImVec4(0.6f, 0.4f, 0.0f, 1.0f);
        case LineKind::input:
            return dark ? ImVec4(0.55f, 0.72f, 1.0f, 1.0f) : ImVec4(0.15f, 0.35f, 0.7f, 1.0f);
        default:
            return ImGui::GetStyle().Colors[ImGuiCol_Text];
    }
}

// The order of ImGui's own names of keys.
int imgui_key(Key key) {
    switch (key) {
        case Key::tab:
            return ImGuiKey_Tab;
        case Key::left:
            return ImGuiKey_LeftArrow;
        case Key::right:
            return ImGuiKey_RightArrow;
        case Key::up:
            return ImGuiKey_UpArrow;
        case Key::down:
            return ImGuiKey_DownArrow;
        case Key::page_up:
            return ImGuiKey_PageUp;
        case Key::page_down:
            return ImGuiKey_PageDown;
        case Key::home:
            return ImGuiKey_Home;
        case Key::end:
            return ImGuiKey_End;
        case Key::del:
            return ImGuiKey_Delete;
        case Key::backspace:
            return ImGuiKey_Backspace;
        case Key::space:
            return ImGuiKey_Space;
        case Key::enter:
            return ImGuiKey_Enter;
        case Key::escape:
            return ImGuiKey_Escape;
        default:
            return -1;
    }
}

// Letters that ImGui knows as shortcuts.
int imgui_letter(char32_t letter) {
    switch (letter) {
        case U'A':
            return ImGuiKey_A;
        case U'C':
            return ImGuiKey_C;
        case U'V':
            return ImGuiKey_V;
        case U'X':
            return ImGuiKey_X;
        case U'Y':
            return ImGuiKey_Y;
        case U'Z':
            return ImGuiKey_Z;
        default:
            return -1;
    }
}

void draw_objects(const std::vector<std::string>& objects, std::vector<bool>& hidden) {
    hidden.resize(objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        bool visible = !hidden[i];
        if (ImGui::Checkbox(objects[i].c_str(), &visible)) hidden[i] = !visible;
        // A long name reaches beyond the panel.
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", objects[i].c_str());
        ImGui::PopID();
    }
}

void draw_colors(const PanelContent& content, PanelAnswers& answers) {
    if (content.colorings.size() < 2) return;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("colours");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::BeginCombo("##colors", label_of(content.coloring).c_str())) {
        for (std::size_t i = 0; i < content.colorings.size(); ++i) {
            const Coloring& one = content.colorings[i];
            ImGui::PushID(static_cast<int>(i));
            const bool is_chosen = one == content.coloring;
            if (ImGui::Selectable(label_of(one).c_str(), is_chosen)) answers.coloring = one;
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
    if (!is_distortion(content.coloring)) return;
    if (ImGui::Button("compare with this shape", ImVec2(-1.0f, 0.0f))) {
        answers.compare_with_this = true;
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Until then: the first that was shown.");
}

}  // namespace

struct Panel::State {
    explicit State(double pixels) : scale(pixels) {}

    double scale;
    std::deque<Input> inputs;
    bool is_dark = true;
    std::string line;
    // Lines that were entered, and which of them the arrows have come to.
    std::vector<std::string> entered;
    std::size_t recalled = 0;
    std::size_t lines_drawn = 0;
    // Frames after one that took input: lists open in the second.
    int frames_owed = 0;

    Canvas canvas_of(gl::Extent window) const {
        const int left = static_cast<int>(kWidth * scale);
        const int below = std::min(static_cast<int>(kConsoleHeight * scale), 2 * window.height / 5);
        return {left, 0, std::max(window.width - left, 1), std::max(window.height - below, 1)};
    }
    void take_inputs();
    bool apply(const Input& input, bool& has_changed);
    void view_section(const PanelContent& content, DisplaySettings& settings,
                      PanelAnswers& answers);
    void side(PanelContent& content, DisplaySettings& settings, PanelAnswers& answers,
              gl::Extent window);
    void console(const PanelContent& content, PanelAnswers& answers, gl::Extent window);
    void prompt(PanelAnswers& answers);
    static int recall(ImGuiInputTextCallbackData* data);
};

Panel::Panel(GlfwWindow& window) : state_(std::make_unique<State>(window.scale())) {
    const double scale = state_->scale;
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = key;
    io.ClipboardUserData = &window;
    io.SetClipboardTextFn = [](void* from, const char* text) {
        static_cast<GlfwWindow*>(from)->set_clipboard(text);
    };
    // ImGui reads the text before it asks again.
    io.GetClipboardTextFn = [](void* from) { return static_cast<GlfwWindow*>(from)->clipboard(); };
    load_font(scale);
    set_sizes(scale);
    set_colors(true);
    ImGui_ImplOpenGL3_Init("#version 330");
}

Panel::~Panel() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

void Panel::feed(const Input& input) {
    state_->inputs.push_back(input);
}

bool Panel::owes_frame() const {
    return !state_->inputs.empty() || state_->frames_owed > 0;
}

bool Panel::wants_mouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool Panel::wants_keys() const {
    return ImGui::GetIO().WantTextInput;
}

// Whether the frame may take `input` too: no button or key changes twice in a frame.
bool Panel::State::apply(const Input& input, bool& has_changed) {
    ImGuiIO& io = ImGui::GetIO();
    const bool changes = input.kind != Input::Kind::move && input.kind != Input::Kind::text &&
                         input.kind != Input::Kind::scroll;
    if (changes && has_changed) return false;
    has_changed = has_changed || changes;
    io.KeyShift = input.modifiers.shift;
    io.KeyCtrl = input.modifiers.ctrl;
    io.KeyAlt = input.modifiers.alt;
    const int button = static_cast<int>(input.button);
    switch (input.kind) {
        case Input::Kind::press:
        case Input::Kind::release:
            io.MouseDown[button] = input.kind == Input::Kind::press;
            [[fallthrough]];
        case Input::Kind::move:
            io.MousePos =
                ImVec2(static_cast<float>(input.at.x()), static_cast<float>(input.at.y()));
            break;
        case Input::Kind::scroll:
            io.MouseWheel += static_cast<float>(input.scroll.y());
            io.MouseWheelH += static_cast<float>(input.scroll.x());
            break;
        case Input::Kind::text:
            io.AddInputCharacter(input.character);
            break;
        case Input::Kind::key_down:
        case Input::Kind::key_up: {
            const int key =
                input.key == Key::character ? imgui_letter(input.character) : imgui_key(input.key);
            if (key >= 0) io.KeysDown[key] = input.kind == Input::Kind::key_down;
            break;
        }
        case Input::Kind::drop:
            break;
    }
    return true;
}

void Panel::State::take_inputs() {
    bool has_changed = false;
    frames_owed = inputs.empty() ? std::max(frames_owed - 1, 0) : kFramesAfterInput;
    while (!inputs.empty() && apply(inputs.front(), has_changed)) inputs.pop_front();
}

void Panel::State::view_section(const PanelContent& content, DisplaySettings& settings,
                                PanelAnswers& answers) {
    constexpr std::array<std::pair<const char*, StandardView>, 7> kViews{
        {{"front", StandardView::front},
         {"back", StandardView::back},
         {"left", StandardView::left},
         {"right", StandardView::right},
         {"top", StandardView::top},
         {"bottom", StandardView::bottom},
         {"3/4", StandardView::three_quarter}}};
    const float width =
        (ImGui::GetContentRegionAvail().x - 3.0f * ImGui::GetStyle().ItemSpacing.x) / 4.0f;
    for (std::size_t i = 0; i < kViews.size(); ++i) {
        if (i % 4 != 0) ImGui::SameLine();
        if (ImGui::Button(kViews[i].first, ImVec2(width, 0.0f))) answers.view = kViews[i].second;
    }
    ImGui::SameLine();
    if (ImGui::Button("all", ImVec2(width, 0.0f))) answers.frame_all = true;
    bool perspective = !content.is_ortho;
    if (ImGui::Checkbox("perspective", &perspective)) answers.toggle_ortho = true;
    ImGui::SameLine(0.5f * ImGui::GetWindowWidth());
    ImGui::Checkbox("dark", &settings.dark);
    ImGui::Checkbox("wire", &settings.wire);
    ImGui::SameLine(0.5f * ImGui::GetWindowWidth());
    ImGui::Checkbox("flat", &settings.flat);
    ImGui::Checkbox("boundaries", &settings.boundaries);
    ImGui::SameLine(0.5f * ImGui::GetWindowWidth());
    ImGui::Checkbox("sharp", &settings.sharp);
    ImGui::Checkbox("normals", &settings.vertex_normals);
    ImGui::SameLine(0.5f * ImGui::GetWindowWidth());
    ImGui::Checkbox("of faces", &settings.face_normals);
    draw_colors(content, answers);
}

void Panel::State::side(PanelContent& content, DisplaySettings& settings, PanelAnswers& answers,
                        gl::Extent window) {
    const int left = canvas_of(window).x;
    ImGui::SetNextWindowPos(ImVec2(0.0f, 0.0f));
    ImGui::SetNextWindowSize(ImVec2(static_cast<float>(left), static_cast<float>(window.height)));
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    if (content.busy) {
        if (ImGui::Button("stop")) answers.cancel = true;
        ImGui::SameLine();
        ImGui::ProgressBar(static_cast<float>(content.fraction), ImVec2(-1.0f, 0.0f),
                           content.stage.c_str());
    } else {
        if (ImGui::Button("run again")) answers.run_again = true;
        ImGui::SameLine();
        if (ImGui::Button("picture")) answers.screenshot = true;
        ImGui::SameLine();
        ImGui::TextDisabled("%.0f ms", content.milliseconds);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", content.driver.c_str());
    }
    ImGui::Separator();
    if (ImGui::CollapsingHeader("View", ImGuiTreeNodeFlags_DefaultOpen)) {
        view_section(content, settings, answers);
    }
    if (ImGui::CollapsingHeader("Objects", ImGuiTreeNodeFlags_DefaultOpen)) {
        draw_objects(content.objects, settings.hidden);
    }
    if (content.tool.has_scene) {
        if (ImGui::CollapsingHeader("Tools", ImGuiTreeNodeFlags_DefaultOpen)) {
            answers.tool = draw_tools(content.tools, content.tool);
        }
        if (ImGui::CollapsingHeader("History")) {
            const ToolAnswers asked = draw_history(content.tool);
            answers.tool.undo = asked.undo;
            answers.tool.redo = asked.redo;
        }
    }
    if (!content.parameters.empty() &&
        ImGui::CollapsingHeader("Parameters", ImGuiTreeNodeFlags_DefaultOpen)) {
        answers.parameters_changed = draw_parameters(content.parameters).has_value();
    }
    ImGui::End();
}

// The arrows recall what was entered before.
int Panel::State::recall(ImGuiInputTextCallbackData* data) {
    auto& state = *static_cast<State*>(data->UserData);
    const std::size_t count = state.entered.size();
    if (data->EventKey == ImGuiKey_UpArrow && state.recalled > 0) --state.recalled;
    if (data->EventKey == ImGuiKey_DownArrow && state.recalled < count) ++state.recalled;
    const std::string text = state.recalled < count ? state.entered[state.recalled] : "";
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, text.c_str());
    return 0;
}

void Panel::State::prompt(PanelAnswers& answers) {
    std::array<char, kLongestText> text{};
    line.copy(text.data(), text.size() - 1);
    ImGui::SetNextItemWidth(-1.0f);
    const bool ended = ImGui::InputTextWithHint(
        "##prompt", "Lua", text.data(), text.size(),
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackHistory, recall, this);
    line = text.data();
    if (!ended || line.empty()) return;
    entered.push_back(line);
    recalled = entered.size();
    answers.line = std::exchange(line, {});
    ImGui::SetKeyboardFocusHere(-1);
}

void Panel::State::console(const PanelContent& content, PanelAnswers& answers, gl::Extent window) {
    const Canvas above = canvas_of(window);
    ImGui::SetNextWindowPos(ImVec2(static_cast<float>(above.x), static_cast<float>(above.height)));
    ImGui::SetNextWindowSize(
        ImVec2(static_cast<float>(above.width), static_cast<float>(window.height - above.height)));
    ImGui::Begin("console", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
    const float room = ImGui::GetFrameHeightWithSpacing();
    ImGui::BeginChild("lines", ImVec2(0.0f, -room));
    const std::size_t count = content.lines.size();
    for (std::size_t i = count - std::min(count, kShownLines); i < count; ++i) {
        const ConsoleLine& one = content.lines[i];
        ImGui::PushStyleColor(ImGuiCol_Text, color_of(one.kind, is_dark));
        ImGui::PushTextWrapPos(0.0f);
        const std::string shown = (one.kind == LineKind::input ? "> " : "") + one.text;
        ImGui::TextUnformatted(shown.c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
    }
    if (lines_drawn != count) {
        ImGui::SetScrollHereY(1.0f);
        frames_owed = std::max(frames_owed, 1);
    }
    lines_drawn = count;
    ImGui::EndChild();
    prompt(answers);
    ImGui::End();
}

Canvas Panel::canvas(gl::Extent window) const {
    return state_->canvas_of(window);
}

PanelAnswers Panel::draw(PanelContent& content, DisplaySettings& settings, gl::Extent window,
                         double seconds) {
    PanelAnswers answers;
    if (state_->is_dark != settings.dark) set_colors(settings.dark);
    state_->is_dark = settings.dark;
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(window.width), static_cast<float>(window.height));
    io.DeltaTime = static_cast<float>(std::clamp(seconds, 1e-4, 0.1));
    state_->take_inputs();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    state_->side(content, settings, answers, window);
    state_->console(content, answers, window);
    const Canvas canvas = state_->canvas_of(window);
    draw_marks(content.tool, content.camera, content.picture_size, canvas);
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    return answers;
}

}  // namespace lissom::window
