#include "scene/grammar.h"

#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <unordered_map>

namespace spectrad {

namespace {

constexpr std::string_view shapes = "mesh sphere box plane disc cylinder cone torus teapot ";
constexpr std::string_view transforms = " translate rotate scale matrix";
/// How an image lies on texture coordinates.
constexpr std::string_view samplings = " filter wrap offset scale rotate";
constexpr std::string_view amounts = " intensity power illuminance irradiance luminance radiance";

/// Attributes: '!' marks required ones. Children: '1' marks those that may stand there once. "#text" allows
/// text.
ElementRule rule(std::string_view name, const std::string& attributes, const std::string& children = {}) {
    ElementRule result;
    result.name = name;
    for (std::string_view word : words(attributes)) {
        const bool required = word.back() == '!';
        if (required) word.remove_suffix(1);
        result.attributes.push_back({std::string(word), required});
    }
    for (std::string_view word : words(children)) {
        if (word == "#text") {
            result.text = true;
            continue;
        }
        const bool once = word.back() == '1';
        if (once) word.remove_suffix(1);
        result.children.emplace_back(word);
        if (once) result.once.emplace_back(word);
    }
    return result;
}

std::vector<ElementRule> makeGrammar() {
    const std::string graph = std::string(shapes) + "node instance import light camera";
    const std::string transform(transforms), amount(amounts), sampling(samplings);
    return {
        rule("scene", "version unit shadows",
             "wavelengths1 spectrum material " + graph + " background1 detector pass region sweep"),
        rule("wavelengths", "from to step projection", "#text"),
        rule("spectrum", "name! quantity relative noise value file column", "#text"),
        rule("material", "name!",
             "diffuse1 gloss1 specular1 conductor1 fluorescence emission1 normal1 bump1"),
        rule("diffuse", "reflectance texture select values roughness" + sampling, "choose"),
        rule("choose", "value! reflectance!"),
        rule("gloss", "ior! roughness reflects"),
        rule("specular", "reflectance! roughness reflects"),
        rule("conductor", "ior! roughness fresnel reflects"),
        rule("fluorescence",
             "excitation emission yield strength emission-unit anti-stokes matrix diagonal mask" + sampling),
        rule("emission", "spectrum luminance radiance scale texture filter"),
        rule("normal", "map! strength" + sampling),
        rule("bump", "height! depth!" + sampling),
        rule("node", "name" + transform + " shadows", graph),
        rule("instance", "of! name" + transform + " shadows"),
        rule("import", "file! name" + transform + " material normals geometry-only shadows", "bind"),
        rule("bind", "material! to!"),
        rule("mesh", "file! material normals"),
        rule("sphere", "radius material"),
        rule("box", "size material"),
        rule("plane", "size material"),
        rule("disc", "radius material"),
        rule("cylinder", "radius height material"),
        rule("cone", "radius height material"),
        rule("torus", "radius tube material"),
        rule("teapot", "size material"),
        rule("light",
             "name type! position target direction angle blend spectrum!" + amount + " scale shadows"),
        rule("background", "spectrum luminance radiance scale texture filter mapping"),
        rule("camera", "name type fov sensor focal height look-from look-at up size"),
        rule("detector", "name! observer sensitivity quantum-efficiency lens filter", "channel"),
        rule("channel", "name! filter!"),
        rule("pass",
             "name! scene camera of mirror lights size samples wavelengths projection as through display "
             "luminance repeat save"),
        rule("region", "name! rect node"),
        rule("sweep", "name! detectors camera pass", "vary"),
        rule("vary", "attributes! values!"),
    };
}

std::string listed(std::span<const std::string> names) {
    return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<std::string> attributeNames(const ElementRule& rule) {
    std::vector<std::string> names;
    for (const ElementRule::Attribute& attribute : rule.attributes)
        names.push_back(attribute.name);
    return names;
}

[[noreturn]] void failUnknownElement(const XmlDocument& document, pugi::xml_node node,
                                     const ElementRule& parent) {
    const std::string_view name = node.name();
    const std::string allowed = parent.children.empty() ? "nothing" : listed(parent.children);
    if (findRule(name)) {
        std::vector<std::string> homes;
        for (const ElementRule& other : grammar())
            if (std::find(other.children.begin(), other.children.end(), name) != other.children.end())
                homes.push_back("<" + other.name + ">");
        throw InputError(
            document.where(node),
            fmt::format("misplaced element <{}> in <{}> ({}; allowed here: {})", name, parent.name,
                        homes.empty() ? "it is the root" : "it stands in " + listed(homes), allowed));
    }
    const auto near = nearest(name, parent.children);
    throw InputError(document.where(node),
                     fmt::format("unknown element <{}> in <{}> (allowed: {}{})", name, parent.name, allowed,
                                 near ? "; did you mean <" + *near + ">?" : ""));
}

void checkAttributes(const XmlDocument& document, pugi::xml_node node, const ElementRule& rule) {
    for (const pugi::xml_attribute attribute : node.attributes()) {
        const std::string_view name = attribute.name();
        if (!rule.takes(name))
            throw InputError(document.where(node, attribute), unknownAttribute(rule, name));
        for (pugi::xml_attribute other = node.first_attribute(); other != attribute;
             other = other.next_attribute())
            if (name == other.name())
                throw InputError(document.where(node),
                                 fmt::format("attribute '{}' stands twice in <{}>", name, rule.name));
    }
    for (const ElementRule::Attribute& attribute : rule.attributes)
        if (attribute.required && !node.attribute(attribute.name.c_str()))
            throw InputError(document.where(node),
                             fmt::format("<{}> needs the attribute '{}'", rule.name, attribute.name));
}

/// Checks one node as a child of `parent`; returns the rule of an element, null for text.
const ElementRule* checkChild(const XmlDocument& document, pugi::xml_node node, const ElementRule& parent) {
    if (node.type() != pugi::node_element) {
        if (!parent.text) {
            const std::string_view text = trimmed(node.value());
            throw InputError(
                document.where(node),
                fmt::format("text '{}' in <{}> (no text may stand there)",
                            text.substr(0, text.find_first_of("\r\n")).substr(0, 40), parent.name));
        }
        return nullptr;
    }
    const std::string_view name = node.name();
    if (std::find(parent.children.begin(), parent.children.end(), name) == parent.children.end())
        failUnknownElement(document, node, parent);
    if (std::find(parent.once.begin(), parent.once.end(), name) != parent.once.end())
        if (const pugi::xml_node first = node.parent().child(node.name()); first != node)
            throw InputError(document.where(node),
                             fmt::format("second <{}> in <{}> (the first is at {})", name, parent.name,
                                         document.where(first).str()));
    const ElementRule* rule = findRule(name);
    checkAttributes(document, node, *rule);
    return rule;
}

}  // namespace

bool ElementRule::takes(std::string_view attribute) const {
    return std::any_of(attributes.begin(), attributes.end(),
                       [&](const Attribute& known) { return known.name == attribute; });
}

std::span<const ElementRule> grammar() {
    static const std::vector<ElementRule> rules = makeGrammar();
    return rules;
}

const ElementRule* findRule(std::string_view element) {
    static const auto byName = [] {
        std::unordered_map<std::string_view, const ElementRule*> map;
        for (const ElementRule& rule : grammar())
            map.emplace(rule.name, &rule);
        return map;
    }();
    const auto found = byName.find(element);
    return found == byName.end() ? nullptr : found->second;
}

std::string unknownAttribute(const ElementRule& rule, std::string_view attribute) {
    const std::vector<std::string> known = attributeNames(rule);
    const auto near = nearest(attribute, known);
    return fmt::format("unknown attribute '{}' in <{}> (allowed: {}{})", attribute, rule.name, listed(known),
                       near ? "; did you mean '" + *near + "'?" : "");
}

void checkStructure(const XmlDocument& document) {
    const pugi::xml_node root = document.root();
    if (std::string_view(root.name()) != "scene")
        throw InputError(document.where(root),
                         fmt::format("the root element is <{}> (a scene begins with <scene>)", root.name()));
    const ElementRule* rule = findRule("scene");
    checkAttributes(document, root, *rule);

    // Document order without recursion: one frame an open element.
    struct Frame {
        pugi::xml_node next;
        const ElementRule* rule;
    };
    std::vector<Frame> open{{root.first_child(), rule}};
    while (!open.empty()) {
        const pugi::xml_node node = open.back().next;
        if (!node) {
            open.pop_back();
            continue;
        }
        open.back().next = node.next_sibling();
        rule = checkChild(document, node, *open.back().rule);
        if (!rule) continue;
        if (open.size() >= maxDepth)
            throw InputError(document.where(node),
                             fmt::format("elements are nested deeper than {} levels (the limit)", maxDepth));
        open.push_back({node.first_child(), rule});
    }
}

}  // namespace spectrad
