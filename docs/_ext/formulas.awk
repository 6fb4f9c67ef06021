# Doxygen's input filter: in /// comments indented text is a formula, to be shown as it stands; a line that is not
# indented ends the @param or @throws before it. Markdown would run both into the paragraph. Sphinx cannot match a
# function that returns decltype(auto): it is shown as auto.
function leave() {
  if (verbatim) print margin "/// @endcode"
  verbatim = 0
}
match($0, /^ *\/\/\/( |$)/) {
  margin = $0
  sub(/\/.*/, "", margin)
  text = $0
  sub(/^ *\/\/\/ ?/, "", text)
  indented = text ~ /^    /
  if (text ~ /^@/) {
    leave()
    command = 1
  } else if (text == "") {
    leave()
    command = 0
  } else if (command && !indented && text !~ /^ /) {
    print margin "///"
    command = 0
  }
  if (indented && !command && !verbatim) {
    print margin "/// @code{.unparsed}"
    verbatim = 1
  } else if (!indented)
    leave()
  print
  next
}
{
  leave()
  command = 0
  gsub(/decltype\(auto\)/, "auto")
  print
}
