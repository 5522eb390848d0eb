#include "viewer/window/panel/panel.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <filesystem>
#include <utility>

#include "kernel/core/error.h"
#include "viewer/window/panel/parameter_widgets.h"
#include "viewer/window/panel/prompt_completion.h"
#include "viewer/window/panel/text_history.h"

namespace lissom::window {
namespace {

constexpr double kWidth = 290.0, kConsoleHeight = 118.0, kLeastConsole = 60.0;
constexpr double kTextHeight = 15.0;
// The last lines of the console are drawn.
constexpr std::size_t kShownLines = 2000;
constexpr std::size_t kLongestText = 1024;
constexpr int kFramesAfterInput = 2;
constexpr std::size_t kShownCandidates = 60;

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
    style.Colors[ImGuiCol_PlotHistogram] = faded(0.8f);
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

constexpr const char* kKeys =
    "left drag: turn; with a tool: the right button, or alt\n"
    "shift and drag, or the middle button: move\n"
    "wheel: nearer, towards the cursor; with ctrl or in a tool's drag: the tool's\n"
    "Home: the selection, else all; with shift: all\n"
    "without a tool: 1 to 7: sides   O: perspective   F: as Home\n"
    "    W: wire   B: boundaries   U: z up or y up\n"
    "Ctrl-Z, Ctrl-Shift-Z: undo, redo\n"
    "Ctrl-S: save the scene   Ctrl-E: export a mesh or hair   F12: picture\n"
    "F5: run again   Esc: stop, or take back\n"
    "Ctrl-Q: end\n"
    "Files can be dropped on the window.";

void draw_played(const PlayedPart& part) {
    char text[64];
    std::snprintf(text, sizeof text, "%zu of %zu, %.3gx%s", part.done, part.count, part.speed,
                  part.is_paused ? ", paused" : "");
    const float fraction =
        static_cast<float>(part.done) / static_cast<float>(std::max<std::size_t>(part.count, 1));
    ImGui::ProgressBar(fraction, ImVec2(-1.0f, 0.0f), text);
    ImGui::TextWrapped("%s is played. Space: pause, . one event, + and -: speed, Esc: stop",
                       part.name.c_str());
}

// Draws it in the console, so that it moves no button.
void draw_left(const PanelContent& content, PanelAnswers& answers) {
    const std::vector<std::filesystem::path>& left = content.left;
    if (left.empty() || content.playing) return;
    if (ImGui::Button("open it")) answers.open_left = true;
    ImGui::SameLine();
    if (ImGui::Button("forget it")) answers.forget_left = true;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", left.front().string().c_str());
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(left.size() > 1 ? "the last of some scenes that were not saved"
                                           : "the scene of another window that was not saved");
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
    explicit State(PanelHost given) : host(std::move(given)), scale(host.scale) {}

    PanelHost host;
    double scale;
    DrawnLists lists;
    std::deque<Input> inputs;
    bool is_dark = true;
    std::string line;
    // Words that may follow at the completed place, and the line up to there.
    std::vector<std::string> candidates;
    std::string completed_text;
    // The line was changed from outside: the cursor goes to its end.
    bool goes_to_end = false;
    // The place named by each line of the console.
    std::vector<std::optional<SourcePlace>> places;
    std::string preset;
    // Lines that were entered, and which of them the arrows have come to.
    std::vector<std::string> entered;
    std::size_t recalled = 0;
    std::size_t lines_drawn = 0;
    // Frames after one that took input: lists open in the second.
    int frames_owed = 0;
    // Height of the console, in units of length: a person drags its upper edge.
    double console_height = kConsoleHeight;
    // Something of the panel lies over the picture, or is dragged there.
    bool is_over_picture = false;

    Canvas canvas_of(gl::Extent window) const {
        const int left = static_cast<int>(kWidth * scale);
        const bool is_usual = console_height == kConsoleHeight;
        const int most = is_usual ? 2 * window.height / 5 : 4 * window.height / 5;
        const int below = std::min(static_cast<int>(console_height * scale), most);
        return {left, 0, std::max(window.width - left, 1), std::max(window.height - below, 1)};
    }
    void take_inputs();
    bool apply(const Input& input, bool& has_changed);
    void view_section(const PanelContent& content, DisplaySettings& settings,
                      PanelAnswers& answers);
    void side(PanelContent& content, DisplaySettings& settings, PanelAnswers& answers,
              gl::Extent window);
    static void export_row(PanelContent& content, PanelAnswers& answers);
    void preset_row(const std::vector<std::string>& presets, PanelAnswers& answers);
    void console(PanelContent& content, PanelAnswers& answers, gl::Extent window);
    void console_line(const ConsoleLine& line, const std::optional<SourcePlace>& place,
                      PanelAnswers& answers) const;
    void find_places(const std::vector<ConsoleLine>& lines);
    void drag_edge(const Canvas& above, gl::Extent window);
    void clear_console(PanelContent& content);
    void prompt(PanelContent& content, PanelAnswers& answers, float beside);
    void candidate_list(float left, float bottom, float width);
    void take_candidate(const std::string& word);
    struct PromptFrame;
    void recall(ImGuiInputTextCallbackData& data);
    void continue_line(ImGuiInputTextCallbackData& data, PanelContent& content);
};

Panel::Panel(PanelHost host) : state_(std::make_unique<State>(std::move(host))) {
    const double scale = state_->scale;
    require(!ImGui::GetCurrentContext(), "there is a panel already");
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = key;
    io.ClipboardUserData = &state_->host;
    io.SetClipboardTextFn = [](void* from, const char* text) {
        const auto& set = static_cast<PanelHost*>(from)->set_clipboard;
        if (set) set(text);
    };
    // ImGui reads the text before it asks again.
    io.GetClipboardTextFn = [](void* from) {
        const auto& get = static_cast<PanelHost*>(from)->clipboard;
        return get ? get() : "";
    };
    load_font(scale);
    set_sizes(scale);
    set_colors(true);
    enter_context();
}

Panel::~Panel() {
    leave_context();
    ImGui::DestroyContext();
}

void Panel::enter_context() {
    ImGui_ImplOpenGL3_Init("#version 330");
}

// Between contexts there is nothing to leave.
void Panel::leave_context() {
    if (ImGui::GetIO().BackendRendererUserData) ImGui_ImplOpenGL3_Shutdown();
}

void Panel::feed(const Input& input) {
    state_->inputs.push_back(input);
}

bool Panel::owes_frame() const {
    return !state_->inputs.empty() || state_->frames_owed > 0;
}

// Only lists over the picture, and a slider being dragged, depend on the place of the mouse in the
// last frame.
bool Panel::wants_mouse(const Vec2& at, gl::Extent window) const {
    const Canvas canvas = state_->canvas_of(window);
    const bool inside = at.x() >= canvas.x && at.y() < canvas.y + canvas.height;
    return !inside || (state_->is_over_picture && ImGui::GetIO().WantCaptureMouse);
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
    ImGui::Checkbox("face normals", &settings.face_normals);
    ImGui::Checkbox("see through", &settings.see_through);
    ImGui::SameLine(0.5f * ImGui::GetWindowWidth());
    bool is_z_up = content.is_z_up;
    if (ImGui::Checkbox("z up", &is_z_up)) answers.toggle_up = true;
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("The view turns; meshes keep their coordinates, in files too.");
    }
    draw_colors(content, answers);
}

// A row of a list, for any characters of its text.
bool is_chosen_of_list(const std::string& text, bool is_present) {
    constexpr std::size_t kMost = 40;
    const ImVec2 begin = ImGui::GetCursorPos();
    const std::string shown = text.size() > kMost ? text.substr(0, kMost) + "..." : text;
    const ImVec2 size(ImGui::CalcTextSize(shown.c_str(), shown.c_str() + shown.size()).x, 0.0f);
    const bool chosen = ImGui::Selectable("##row", is_present, 0, size);
    ImGui::SetCursorPos(begin);
    ImGui::TextUnformatted(shown.c_str(), shown.c_str() + shown.size());
    return chosen;
}

// Draws a list of existing names, a name, and its actions.
void Panel::State::preset_row(const std::vector<std::string>& presets, PanelAnswers& answers) {
    ImGui::PushID("presets");
    const ImGuiStyle& style = ImGui::GetStyle();
    const auto width = [&](const char* label) {
        return ImGui::CalcTextSize(label).x + 2.0f * style.FramePadding.x + style.ItemSpacing.x;
    };
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - width("save") - width("delete") -
                            ImGui::GetFrameHeight() - style.ItemSpacing.x);
    std::array<char, kLongestText> name{};
    preset.copy(name.data(), name.size() - 1);
    forget_unfit_history("##preset", name.data());
    ImGui::InputTextWithHint("##preset", "preset", name.data(), name.size());
    preset = name.data();
    ImGui::SameLine();
    if (ImGui::BeginCombo("##presets", "", ImGuiComboFlags_NoPreview)) {
        for (std::size_t i = 0; i < presets.size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            if (is_chosen_of_list(presets[i], presets[i] == preset)) {
                answers.load_preset = preset = presets[i];
            }
            ImGui::PopID();
        }
        if (presets.empty()) ImGui::TextDisabled("none yet: write a name and save");
        ImGui::EndCombo();
    }
    ImGui::SameLine();
    const bool has_name = preset.find_first_not_of(' ') != std::string::npos;
    ImGui::BeginDisabled(!has_name);
    if (ImGui::Button("save")) answers.save_preset = preset;
    ImGui::SameLine();
    if (ImGui::Button("delete")) answers.remove_preset = std::exchange(preset, {});
    ImGui::EndDisabled();
    ImGui::PopID();
}

// A name for the file, and the button that writes it.
void Panel::State::export_row(PanelContent& content, PanelAnswers& answers) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float button = ImGui::CalcTextSize("export").x + 2.0f * style.FramePadding.x;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - style.ItemSpacing.x);
    std::array<char, kLongestText> name{};
    content.export_name.copy(name.data(), name.size() - 1);
    forget_unfit_history("##export", name.data());
    ImGui::InputTextWithHint("##export", "file: .obj .glb .ply .usda", name.data(), name.size());
    content.export_name = name.data();
    ImGui::SameLine();
    if (ImGui::Button("export")) answers.exports = true;
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip(
            "Ctrl-E: writes the mesh with a selection, else the only one to be seen;\n"
            "if the ending is one of hair (.usda .hair .data .rib), the hair");
    }
}

void Panel::State::side(PanelContent& content, DisplaySettings& settings, PanelAnswers& answers,
                        gl::Extent window) {
    const int left = canvas_of(window).x;
    ImGui::SetNextWindowPos(ImVec2(0.0f, 0.0f));
    ImGui::SetNextWindowSize(ImVec2(static_cast<float>(left), static_cast<float>(window.height)));
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    if (content.playing) {
        draw_played(*content.playing);
    } else if (content.busy) {
        if (ImGui::Button("stop")) answers.cancel = true;
        ImGui::SameLine();
        ImGui::ProgressBar(static_cast<float>(content.fraction), ImVec2(-1.0f, 0.0f),
                           content.stage.c_str());
    } else {
        if (ImGui::Button("run again")) answers.run_again = true;
        ImGui::SameLine();
        if (ImGui::Button("picture")) answers.screenshot = true;
        if (content.tool.has_scene) {
            ImGui::SameLine();
            if (ImGui::Button("save")) answers.save = true;
        }
        ImGui::SameLine();
        if (content.draws_picture) {
            ImGui::TextDisabled("drawing");
        } else {
            ImGui::TextDisabled("%.0f ms", content.milliseconds);
        }
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", content.driver.c_str());
        ImGui::SameLine();
        ImGui::TextDisabled("?");
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", kKeys);
    }
    ImGui::Separator();
    ImGui::BeginDisabled(content.playing.has_value());
    if (ImGui::CollapsingHeader("View", ImGuiTreeNodeFlags_DefaultOpen)) {
        view_section(content, settings, answers);
    }
    if (!content.parameters.empty() &&
        ImGui::CollapsingHeader("Parameters", ImGuiTreeNodeFlags_DefaultOpen)) {
        if (content.presets) preset_row(*content.presets, answers);
        answers.parameters_changed = draw_parameters(content.parameters).has_value();
    }
    if (content.tool.has_scene) {
        if (ImGui::CollapsingHeader("Tools", ImGuiTreeNodeFlags_DefaultOpen)) {
            const ToolAnswers asked = draw_tools(content.tools, content.tool);
            answers.tool.tool = asked.tool;
            answers.tool.parameter = asked.parameter;
        }
        if (ImGui::CollapsingHeader("History")) {
            const ToolAnswers asked = draw_history(content.tool);
            answers.tool.undo = asked.undo;
            answers.tool.redo = asked.redo;
        }
    }
    // Last, as it grows: no button moves then.
    if (ImGui::CollapsingHeader("Objects", ImGuiTreeNodeFlags_DefaultOpen)) {
        if (content.tool.has_scene) {
            export_row(content, answers);
            answers.tool.object = draw_scene_objects(content.tool).object;
        } else {
            draw_objects(content.objects, settings.hidden);
        }
    }
    ImGui::EndDisabled();
    ImGui::End();
}

void replace_text(ImGuiInputTextCallbackData& data, const std::string& text, std::size_t cursor) {
    data.DeleteChars(0, data.BufTextLen);
    data.InsertChars(0, text.c_str());
    data.CursorPos = static_cast<int>(cursor);
    data.ClearSelection();
    forget_history_in_use();
}

// The arrows recall earlier lines.
void Panel::State::recall(ImGuiInputTextCallbackData& data) {
    const std::size_t count = entered.size();
    if (data.EventKey == ImGuiKey_UpArrow && recalled > 0) --recalled;
    if (data.EventKey == ImGuiKey_DownArrow && recalled < count) ++recalled;
    const std::string text = recalled < count ? entered[recalled] : "";
    replace_text(data, text, text.size());
}

// Takes an answer to Tab, if the line is still the one that was asked about.
void Panel::State::continue_line(ImGuiInputTextCallbackData& data, PanelContent& content) {
    if (std::exchange(goes_to_end, false)) replace_text(data, data.Buf, data.BufTextLen);
    const std::string now(data.Buf, static_cast<std::size_t>(data.BufTextLen));
    const auto cursor = static_cast<std::size_t>(data.CursorPos);
    if (now.substr(0, cursor) != completed_text) candidates.clear();
    const auto answer = std::exchange(content.completion, std::nullopt);
    if (!answer || answer->text != now.substr(0, cursor)) return;
    const CompletedLine next =
        completed_line(now, cursor, answer->found.begin, answer->found.words);
    replace_text(data, next.line, next.cursor);
    candidates = next.candidates;
    completed_text = next.line.substr(0, next.cursor);
}

// In place of the beginning that all candidates have in common.
void Panel::State::take_candidate(const std::string& word) {
    std::size_t common = std::min(word.size(), completed_text.size());
    while (!completed_text.ends_with(word.substr(0, common))) --common;
    line.insert(completed_text.size(), word.substr(common));
    candidates.clear();
    goes_to_end = true;
}

void Panel::State::candidate_list(float left, float bottom, float width) {
    if (candidates.empty()) return;
    ImGui::SetNextWindowPos(ImVec2(left, bottom), ImGuiCond_Always, ImVec2(0.0f, 1.0f));
    ImGui::SetNextWindowSizeConstraints(ImVec2(0.0f, 0.0f), ImVec2(width, 1e6f));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyle().Colors[ImGuiCol_PopupBg]);
    ImGui::Begin("candidates", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_AlwaysAutoResize);
    const std::size_t count = std::min(candidates.size(), kShownCandidates);
    const float gap = 2.0f * ImGui::GetStyle().ItemSpacing.x;
    float used = 0.0f;
    std::optional<std::string> taken;
    for (std::size_t i = 0; i < count; ++i) {
        const ImVec2 size = ImGui::CalcTextSize(candidates[i].c_str());
        used += size.x + gap;
        if (i > 0 && used < 0.9f * width) ImGui::SameLine(0.0f, gap);
        if (used >= 0.9f * width) used = size.x + gap;
        if (ImGui::Selectable(candidates[i].c_str(), false, 0, size)) taken = candidates[i];
    }
    if (count < candidates.size()) ImGui::TextDisabled("and %zu more", candidates.size() - count);
    ImGui::End();
    ImGui::PopStyleColor();
    if (taken) take_candidate(*taken);
}

// Data of a frame for the prompt's callbacks.
struct Panel::State::PromptFrame {
    State& state;
    PanelContent& content;
    PanelAnswers& answers;

    void take(ImGuiInputTextCallbackData& data) const {
        if (data.EventFlag == ImGuiInputTextFlags_CallbackHistory) state.recall(data);
        if (data.EventFlag == ImGuiInputTextFlags_CallbackAlways) {
            state.continue_line(data, content);
        }
        if (data.EventFlag == ImGuiInputTextFlags_CallbackCompletion) {
            answers.complete.emplace(data.Buf, static_cast<std::size_t>(data.CursorPos));
        }
    }
};

// Leaves room `beside` it.
void Panel::State::prompt(PanelContent& content, PanelAnswers& answers, float beside) {
    std::array<char, kLongestText> text{};
    line.copy(text.data(), text.size() - 1);
    ImGui::SetNextItemWidth(-beside);
    if (goes_to_end) ImGui::SetKeyboardFocusHere();
    forget_unfit_history("##prompt", text.data());
    PromptFrame frame{*this, content, answers};
    const auto callback = [](ImGuiInputTextCallbackData* data) {
        static_cast<PromptFrame*>(data->UserData)->take(*data);
        return 0;
    };
    const bool ended = ImGui::InputTextWithHint(
        "##prompt", "Lua: Tab completes", text.data(), text.size(),
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackHistory |
            ImGuiInputTextFlags_CallbackCompletion | ImGuiInputTextFlags_CallbackAlways,
        callback, &frame);
    line = text.data();
    if (!ended || line.empty()) return;
    candidates.clear();
    entered.push_back(line);
    recalled = entered.size();
    answers.line = std::exchange(line, {});
    ImGui::SetKeyboardFocusHere(-1);
}

// Those of lines that are new; a file that appears later is not looked for again.
void Panel::State::find_places(const std::vector<ConsoleLine>& lines) {
    const auto exists = [](const std::string& name) {
        std::error_code error;
        return std::filesystem::is_regular_file(name, error);
    };
    for (std::size_t i = places.size(); i < lines.size(); ++i) {
        places.push_back(find_place(lines[i].text, exists));
    }
}

void Panel::State::console_line(const ConsoleLine& one, const std::optional<SourcePlace>& place,
                                PanelAnswers& answers) const {
    ImGui::PushStyleColor(ImGuiCol_Text, color_of(one.kind, is_dark));
    ImGui::PushTextWrapPos(0.0f);
    const std::string times =
        one.times > 1 ? "  (" + std::to_string(one.times) + " times)" : std::string();
    const std::string shown = (one.kind == LineKind::input ? "> " : "") + one.text + times;
    ImGui::TextUnformatted(shown.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    if (!place || !ImGui::IsItemHovered()) return;
    ImGui::SetTooltip("click: line %d of %s in your editor", place->line, place->file.c_str());
    if (ImGui::IsItemClicked()) answers.place = place;
}

// The upper edge of the console, which makes it larger or smaller.
void Panel::State::drag_edge(const Canvas& above, gl::Extent window) {
    constexpr float kEdge = 7.0f;
    const ImVec2 begin = ImGui::GetCursorPos();
    ImGui::SetCursorPos(ImVec2(0.0f, 0.0f));
    ImGui::InvisibleButton(
        "edge", ImVec2(static_cast<float>(above.width), kEdge * static_cast<float>(scale)));
    const bool is_held = ImGui::IsItemActive();
    if (is_held || ImGui::IsItemHovered()) {
        const ImVec2 corner = ImGui::GetItemRectMin(), end = ImGui::GetItemRectMax();
        ImGui::GetWindowDrawList()->AddRectFilled(
            corner, ImVec2(end.x, corner.y + 2.0f * static_cast<float>(scale)),
            ImGui::GetColorU32(ImGuiCol_ButtonActive));
    }
    ImGui::SetCursorPos(begin);
    if (!is_held) return;
    const double wanted = (window.height - ImGui::GetIO().MousePos.y) / scale;
    console_height =
        std::clamp(wanted, kLeastConsole, std::max(kLeastConsole, 0.8 * window.height / scale));
}

void Panel::State::clear_console(PanelContent& content) {
    content.lines.clear();
    places.clear();
    lines_drawn = 0;
}

void Panel::State::console(PanelContent& content, PanelAnswers& answers, gl::Extent window) {
    const Canvas above = canvas_of(window);
    ImGui::SetNextWindowPos(ImVec2(static_cast<float>(above.x), static_cast<float>(above.height)));
    ImGui::SetNextWindowSize(
        ImVec2(static_cast<float>(above.width), static_cast<float>(window.height - above.height)));
    ImGui::Begin("console", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    drag_edge(above, window);
    draw_left(content, answers);
    const float room = ImGui::GetFrameHeightWithSpacing();
    ImGui::BeginChild("lines", ImVec2(0.0f, -room));
    const std::size_t count = content.lines.size();
    find_places(content.lines);
    for (std::size_t i = count - std::min(count, kShownLines); i < count; ++i) {
        console_line(content.lines[i], places[i], answers);
    }
    if (lines_drawn != count) {
        ImGui::SetScrollHereY(1.0f);
        frames_owed = std::max(frames_owed, 1);
    }
    lines_drawn = count;
    ImGui::EndChild();
    const float width = ImGui::CalcTextSize("clear").x + 2.0f * ImGui::GetStyle().FramePadding.x +
                        ImGui::GetStyle().ItemSpacing.x;
    prompt(content, answers, width);
    const ImVec2 corner = ImGui::GetItemRectMin(), end = ImGui::GetItemRectMax();
    ImGui::SameLine();
    if (ImGui::Button("clear")) clear_console(content);
    ImGui::End();
    candidate_list(corner.x, corner.y, end.x - corner.x);
}

Canvas Panel::canvas(gl::Extent window) const {
    return state_->canvas_of(window);
}

PanelAnswers Panel::make(PanelContent& content, DisplaySettings& settings, gl::Extent window,
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
    draw_marks(content.tool, {content.camera, content.picture_size, canvas, state_->scale});
    state_->is_over_picture =
        !state_->candidates.empty() || ImGui::IsAnyMouseDown() ||
        ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    ImGui::Render();
    state_->lists.see(*ImGui::GetDrawData(), canvas);
    return answers;
}

const DrawnLists& Panel::lists() const {
    return state_->lists;
}

void Panel::draw(PanelPart part) const {
    ImDrawData data = *ImGui::GetDrawData();
    std::vector<ImDrawList*> over = state_->lists.over();
    if (part == PanelPart::over_picture) {
        data.CmdLists = over.data();
        data.CmdListsCount = count_of(over);
    }
    ImGui_ImplOpenGL3_RenderDrawData(&data);
}

}  // namespace lissom::window
