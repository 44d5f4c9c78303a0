# Shapes are written as "#V by 3", marks of files as "<UDIM>"; Doxygen would take them for a link and a tag.
/\/\/\//{
  s/#([A-Za-z])/\\#\1/g
  s/<([A-Za-z_.]+)>/\\<\1\\>/g
}
