# What Breathe needs of comments: a paragraph in place of @throws, of which it takes one name only, and no links to files.
s|@throws|\n/// @par Raises\n/// |
\|///|s|(\w+)\.h\b|\1\&#46;h|g
