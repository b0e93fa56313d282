#include "viewer/script.h"

#include "base/error.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>

namespace spectrad::view {

namespace {

struct Line {
    std::vector<std::string> words;
    SourceLocation where;

    [[noreturn]] void refuse(const std::string& why) const { throw InputError(where, why); }
    void need(size_t least, size_t most, const char* form) const {
        if (words.size() < least + 1 || words.size() > most + 1) refuse(std::string("the form is: ") + form);
    }
    [[nodiscard]] double number(size_t i) const {
        const std::optional<double> value = parseDouble(words.at(i));
        constexpr double most = 1e6;
        if (!value || !(*value >= -most && *value <= most))
            refuse("'" + words[i] + "' is not a number from -1e6 to 1e6");
        return *value;
    }
    [[nodiscard]] int button(size_t i) const {
        if (i >= words.size() || words[i] == "left") return 0;
        if (words[i] == "right") return 1;
        if (words[i] == "middle") return 2;
        refuse("'" + words[i] + "' is no button (allowed: left, right, middle)");
    }
};

const std::map<std::string, int>& specialKeys() {
    static const std::map<std::string, int> keys = [] {
        std::map<std::string, int> made{{"escape", escape},       {"enter", enter}, {"tab", tab},
                                        {"backspace", backspace}, {"delete", del},  {"right", right},
                                        {"left", left},           {"down", down},   {"up", up},
                                        {"home", home},           {"end", end},     {"pageup", pageUp},
                                        {"pagedown", pageDown},   {"space", ' '},   {"insert", insert}};
        for (int f = f1; f <= f12; ++f)
            made["f" + std::to_string(f - f1 + 1)] = f;
        return made;
    }();
    return keys;
}

/// "A", "f1", "ctrl+S", "shift+left": pressed and let go.
std::vector<Event> keyEvents(const Line& line, std::string name) {
    unsigned modifiers = 0;
    for (const auto& [prefix, modifier] : {std::pair{"ctrl+", control}, {"shift+", shift}, {"alt+", alt}})
        if (name.starts_with(prefix)) {
            name.erase(0, std::string(prefix).size());
            modifiers |= modifier;
        }
    int code = 0;
    if (const auto found = specialKeys().find(name); found != specialKeys().end())
        code = found->second;
    else if (name.size() == 1 && name[0] > ' ' && name[0] <= '~')
        code = name[0] >= 'a' && name[0] <= 'z' ? name[0] - 'a' + 'A' : name[0];
    else
        line.refuse("'" + name + "' is no key (one character, escape, tab, left, f1 …, perhaps after ctrl+)");
    std::vector<Event> events{{Event::Kind::key, code, true, modifiers, 0, 0}};
    // What a keyboard types as well, for fields of text.
    if (name.size() == 1 && (modifiers & (control | alt)) == 0)
        events.push_back({Event::Kind::text, name[0], true, 0, 0, 0});
    events.push_back({Event::Kind::key, code, false, modifiers, 0, 0});
    return events;
}

Event moved(double x, double y) {
    return {Event::Kind::move, 0, false, 0, x, y};
}
Event button(int which, bool pressed) {
    return {Event::Kind::button, which, pressed, 0, 0, 0};
}

using Reader = std::function<void(const Line&, Action&)>;

const std::vector<std::pair<std::string, Reader>>& readers() {
    using Kind = Action::Kind;
    const auto place = [](const Line& line, Action& action) {
        action.x = line.number(1);
        action.y = line.number(2);
    };
    const auto file = [](Kind kind, const char* form) {
        return [=](const Line& line, Action& action) {
            line.need(1, 1, form);
            action.kind = kind;
            action.text = line.words[1];
        };
    };
    static const std::vector<std::pair<std::string, Reader>> all{
        {"key",
         [](const Line& line, Action& action) {
             line.need(1, 1, "key NAME");
             action.events = keyEvents(line, line.words[1]);
         }},
        {"move",
         [](const Line& line, Action& action) {
             line.need(2, 2, "move X Y");
             action.events = {moved(line.number(1), line.number(2))};
         }},
        {"press",
         [](const Line& line, Action& action) {
             line.need(0, 1, "press [left|right|middle]");
             action.events = {button(line.button(1), true)};
         }},
        {"release",
         [](const Line& line, Action& action) {
             line.need(0, 1, "release [left|right|middle]");
             action.events = {button(line.button(1), false)};
         }},
        {"click",
         [](const Line& line, Action& action) {
             line.need(2, 3, "click X Y [left|right|middle]");
             action.events = {moved(line.number(1), line.number(2)), button(line.button(3), true),
                              button(line.button(3), false)};
         }},
        {"drag",
         [](const Line& line, Action& action) {
             line.need(4, 5, "drag X1 Y1 X2 Y2 [left|right|middle]");
             const double x1 = line.number(1), y1 = line.number(2), x2 = line.number(3), y2 = line.number(4);
             action.events = {moved(x1, y1), button(line.button(5), true)};
             constexpr int steps = 4;
             for (int i = 1; i <= steps; ++i)
                 action.events.push_back(moved(x1 + (x2 - x1) * i / steps, y1 + (y2 - y1) * i / steps));
             action.events.push_back(button(line.button(5), false));
         }},
        {"scroll",
         [](const Line& line, Action& action) {
             line.need(1, 1, "scroll STEPS");
             action.events = {{Event::Kind::scroll, 0, false, 0, 0, line.number(1)}};
         }},
        {"type",
         [](const Line& line, Action& action) {
             line.need(1, 1, "type TEXT");
             for (char c : line.words[1])
                 action.events.push_back({Event::Kind::text, static_cast<unsigned char>(c), true, 0, 0, 0});
         }},
        {"set", file(Kind::set, "set WHAT=VALUE")},
        {"camera",
         [](const Line& line, Action& action) {
             line.need(1, 3, "camera orbit|pan|dolly|frame|reset [X [Y]]");
             const std::vector<std::string> known{"orbit", "pan", "dolly", "frame", "reset"};
             if (std::find(known.begin(), known.end(), line.words[1]) == known.end())
                 line.refuse("'" + line.words[1] +
                             "' is no movement (allowed: orbit, pan, dolly, frame, reset)");
             action.kind = Kind::camera;
             action.text = line.words[1];
             if (line.words.size() > 2) action.x = line.number(2);
             if (line.words.size() > 3) action.y = line.number(3);
         }},
        {"resize",
         [place](const Line& line, Action& action) {
             line.need(2, 2, "resize WIDTH HEIGHT");
             action.kind = Kind::resize;
             place(line, action);
             constexpr double most = 16384;
             if (action.x < 0 || action.y < 0 || action.x > most || action.y > most)
                 line.refuse("a window of that size is not possible (0…16384 on a side)");
         }},
        {"screenshot", file(Kind::screenshot, "screenshot FILE.png")},
        {"save",
         [](const Line& line, Action& action) {
             line.need(2, 2, "save picture|cube|scene FILE");
             const std::string& what = line.words[1];
             if (what != "picture" && what != "cube" && what != "scene")
                 line.refuse("'" + what + "' cannot be saved (allowed: picture, cube, scene)");
             action.kind = what == "picture" ? Kind::savePicture
                           : what == "cube"  ? Kind::saveCube
                                             : Kind::saveScene;
             action.text = line.words[2];
         }},
        {"channels", file(Kind::channels, "channels FILE.exr")},
        {"pins", file(Kind::pins, "pins FILE.csv")},
        {"pin",
         [place](const Line& line, Action& action) {
             line.need(2, 2, "pin X Y");
             action.kind = Kind::pin;
             place(line, action);
         }},
        {"wait",
         [](const Line& line, Action& action) {
             line.need(1, 1, "wait FRAMES");
             action.kind = Kind::wait;
             action.x = line.number(1);
         }},
        {"jobs",
         [](const Line& line, Action& action) {
             line.need(1, 1, "jobs wait|beside");
             if (line.words[1] != "wait" && line.words[1] != "beside")
                 line.refuse("'" + line.words[1] + "' is no way of jobs (allowed: wait, beside)");
             action.kind = Kind::jobs;
             action.x = line.words[1] == "wait" ? 1 : 0;
         }},
        {"finish",
         [](const Line& line, Action& action) {
             line.need(0, 0, "finish");
             action.kind = Kind::finish;
         }},
        {"close",
         [](const Line& line, Action& action) {
             line.need(0, 0, "close");
             action.kind = Kind::close;
         }},
    };
    return all;
}

}  // namespace

std::vector<Action> parseScript(std::string_view text, const std::string& file) {
    std::vector<Action> actions;
    int number = 0;
    for (std::string_view raw : split(text, '\n')) {
        ++number;
        // A comment starts where a word could: srgb:#c04020 is none.
        Line line{{}, {file, number, 1}};
        for (std::string_view word : split(raw, ' ')) {
            while (!word.empty() && (word.back() == '\r' || word.back() == '\t'))
                word.remove_suffix(1);
            if (word.starts_with('#')) break;
            if (!word.empty()) line.words.emplace_back(word);
        }
        if (line.words.empty()) continue;
        std::vector<std::string> names;
        const Reader* reader = nullptr;
        for (const auto& [name, read] : readers()) {
            names.push_back(name);
            if (name == line.words[0]) reader = &read;
        }
        if (!reader)
            line.refuse(fmt::format("'{}' is no action (allowed: {}){}", line.words[0],
                                    fmt::join(names, ", "), didYouMean(line.words[0], names)));
        Action action;
        action.where = line.where;
        (*reader)(line, action);
        actions.push_back(std::move(action));
    }
    return actions;
}

}  // namespace spectrad::view
