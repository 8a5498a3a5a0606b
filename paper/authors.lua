-- Authors and affiliations of a paper for the Journal of Open Source Software, as pandoc's own template takes them.
local text = pandoc.utils.stringify

function Meta(meta)
  local names, places = {}, {}
  for _, place in ipairs(meta.affiliations) do
    places[text(place.index)] = text(place.name)
  end
  for _, author in ipairs(meta.authors) do
    local place = places[text(author.affiliation)]
    names[#names + 1] = pandoc.MetaInlines { pandoc.Str(text(author.literal or author.name) .. " (" .. place .. ")") }
  end
  meta.author = pandoc.MetaList(names)
  return meta
end
