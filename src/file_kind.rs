//! What a file is, by its first bytes: so that one which is not what was expected gets one sentence of what to do.

/// A kind of file: what messages call it, and what to do with it where a model is expected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FileKind {
    pub name: &'static str,
    pub advice: &'static str,
}

const BLENDER: &str = "open it in Blender and export it as glTF 2.0";
const FREECAD: &str = "open it in FreeCAD and export it as glTF";
const MESHLAB: &str = "convert it to .glb, with Blender or MeshLab";
const PDAL: &str = "make a mesh of its points with CloudCompare or PDAL, and export that as glTF";
const PYVISTA: &str = "extract its surface and export it as glTF, with PyVista (`Plotter.export_gltf`) or ParaView";
const VOLUME: &str = "extract a surface from the volume and export it as glTF, with 3D Slicer";
const PICTURE: &str = "a model is expected; pictures are named by materials and by the filter `texture`";
const UNPACK: &str = "unpack it and name the .glb or .gltf in it";
const TILES: &str = "take the .glb out of it, with `3d-tiles-tools`";
const UNKNOWN: &str = "expected glTF 2.0, as .gltf (JSON) or .glb";

/// Bytes at a place, and what begins so.
type Magic = (usize, &'static [u8], &'static str, &'static str);

const MAGICS: &[Magic] = &[
    (0, b"glTF", "a binary glTF file", "`lenspeel init` writes a lens spec for it"),
    (0, b"Kaydara FBX Binary", "an FBX file", BLENDER),
    (0, b"; FBX ", "an FBX file", BLENDER),
    (0, b"BLENDER", "a Blender file", BLENDER),
    (0, b"PXR-USDC", "a USD file", BLENDER),
    (0, b"#usda", "a USD file", BLENDER),
    (0, b"Ogawa", "an Alembic file", BLENDER),
    (0, b"3D Geometry File Format", "a Rhino file", "export it from Rhino as glTF"),
    (0, b"\xff\xfe\xff\x0eS\0k\0e\0t\0c\0h\0U\0p\0", "a SketchUp file", "export it from SketchUp as glTF"),
    (0, b"AC10", "a DWG drawing", FREECAD),
    (0, b"ply\n", "a PLY file", MESHLAB),
    (0, b"ply\r", "a PLY file", MESHLAB),
    (0, b"OFF\n", "an OFF file", MESHLAB),
    (0, b"#VRML", "a VRML file", BLENDER),
    (0, b"LASF", "a LAS or LAZ point cloud", PDAL),
    (0, b"ASTM-E57", "an E57 point cloud", PDAL),
    (0, b"# .PCD", "a PCD point cloud", PDAL),
    (0, b"# vtk DataFile", "a VTK file", PYVISTA),
    (0, b"\x89HDF\r\n\x1a\n", "an HDF5 file", PYVISTA),
    (0, b"CDF\x01", "a NetCDF file", PYVISTA),
    (0, b"CDF\x02", "a NetCDF file", PYVISTA),
    (128, b"DICM", "a DICOM image", VOLUME),
    (344, b"n+1\0", "a NIfTI volume", VOLUME),
    (0, b"NRRD", "an NRRD volume", VOLUME),
    (0, b"b3dm", "a 3D Tiles file (b3dm)", TILES),
    (0, b"i3dm", "a 3D Tiles file (i3dm)", TILES),
    (0, b"pnts", "a 3D Tiles point cloud (pnts)", PDAL),
    (0, b"cmpt", "a 3D Tiles file (cmpt)", TILES),
    (0, b"\x89PNG", "a PNG image", PICTURE),
    (0, b"\xff\xd8\xff", "a JPEG image", PICTURE),
    (0, b"GIF8", "a GIF image", PICTURE),
    (8, b"WEBP", "a WebP image", PICTURE),
    (0, b"\xabKTX ", "a KTX texture", PICTURE),
    (0, b"DDS ", "a DDS texture", PICTURE),
    (0, b"\x76\x2f\x31\x01", "an OpenEXR image", PICTURE),
    (0, b"#?RADIANCE", "a Radiance HDR image", PICTURE),
    (0, b"II*\0", "a TIFF image", PICTURE),
    (0, b"MM\0*", "a TIFF image", PICTURE),
    (0, b"%PDF", "a PDF document", UNKNOWN),
    (0, b"PK\x03\x04", "a zip archive", UNPACK),
    (0, b"\x1f\x8b", "a gzip archive", UNPACK),
    (0, b"\x28\xb5\x2f\xfd", "a Zstandard archive", UNPACK),
    (0, b"7z\xbc\xaf", "a 7z archive", UNPACK),
    (0, b"\xfd7zXZ", "an xz archive", UNPACK),
    (0, b"Rar!", "a RAR archive", UNPACK),
    (0, b"\x7fELF", "a program", UNKNOWN),
    (0, b"MM", "a 3DS file", BLENDER),
];

/// What text is found in, among the first characters that are not blank.
const TEXTS: &[(&str, &str, &str)] = &[
    ("version https://git-lfs", "a Git LFS pointer, not the file itself", "get the file with `git lfs pull`"),
    ("<collada", "a COLLADA file", BLENDER),
    ("<x3d", "an X3D file", BLENDER),
    ("<vtkfile", "a VTK file", PYVISTA),
    ("<xdmf", "an XDMF file", PYVISTA),
    ("<citymodel", "a CityGML file", "convert it to CityJSON with citygml-tools, and that to glTF with cjio"),
    ("<html", "a web page", "download the file itself, not the page that shows it"),
    ("<!doctype html", "a web page", "download the file itself, not the page that shows it"),
    ("<svg", "an SVG drawing", PICTURE),
    ("<?xml", "an XML file", UNKNOWN),
];

/// So many bytes tell what a text is.
const LOOKED_AT: usize = 4096;

impl FileKind {
    /// JSON that looks like glTF 2.0.
    pub const GLTF: Self = Self { name: "a glTF file", advice: "`lenspeel init` writes a lens spec for it" };
    /// JSON of no kind that is known here.
    pub const JSON: Self = Self { name: "JSON that is not glTF", advice: UNKNOWN };

    /// By its first bytes and how many there are in all.
    pub fn of(bytes: &[u8]) -> Self {
        let kind = |name, advice| Self { name, advice };
        if bytes.is_empty() {
            return kind("an empty file", UNKNOWN);
        }
        if is_binary_stl(bytes) {
            return kind("an STL file", MESHLAB);
        }
        if let Some((.., name, advice)) = MAGICS.iter().find(|(at, magic, ..)| is_at(bytes, *at, magic)) {
            return if *name == "a zip archive" { zip(bytes) } else { kind(name, advice) };
        }
        match text(bytes) {
            Some(text) => Self::of_text(&text, bytes),
            None => kind("not a file of a kind that is known here", UNKNOWN),
        }
    }

    fn of_text(text: &str, bytes: &[u8]) -> Self {
        let kind = |name, advice| Self { name, advice };
        let start = text.trim_start_matches('\u{feff}').trim_start();
        if start.starts_with("ISO-10303-21") {
            let is_ifc = bytes.windows(4).take(LOOKED_AT).any(|w| w == b"IFC2" || w == b"IFC4" || w == b"IFCX");
            return if is_ifc {
                kind("an IFC model", "convert it with IfcConvert: `IfcConvert model.ifc model.glb`")
            } else {
                kind("a STEP file", FREECAD)
            };
        }
        if start.starts_with('{') || start.starts_with('[') && !is_spec(start) {
            return json(start);
        }
        let lower = start.to_ascii_lowercase();
        if lower.starts_with("solid") && (lower.contains("facet") || lower.contains("endsolid")) {
            return kind("an STL file", MESHLAB);
        }
        if let Some((_, name, advice)) = TEXTS.iter().find(|(mark, ..)| lower.contains(mark)) {
            return kind(name, advice);
        }
        if is_spec(start) {
            return kind("a lens spec", "name the model, or use `render`, `check` or `explain` for a spec");
        }
        if is_obj(start) {
            return kind("an OBJ file", MESHLAB);
        }
        if lower.starts_with("0\n") && lower.contains("section") {
            return kind("a DXF drawing", FREECAD);
        }
        kind("a text that is no model", UNKNOWN)
    }
}

fn is_at(bytes: &[u8], at: usize, magic: &[u8]) -> bool {
    bytes.get(at..).is_some_and(|rest| rest.starts_with(magic))
}

/// An 80-byte header, a count, and 50 bytes a triangle; the header may be anything.
fn is_binary_stl(bytes: &[u8]) -> bool {
    let Some(count) = bytes.get(80..84).and_then(|c| c.try_into().ok()).map(u32::from_le_bytes) else { return false };
    count > 0 && bytes.len() as u64 == 84 + 50 * u64::from(count)
}

/// The name of the first entry stands in an archive's first bytes.
fn zip(bytes: &[u8]) -> FileKind {
    let head = &bytes[..bytes.len().min(LOOKED_AT)];
    let holds = |what: &[u8]| head.windows(what.len()).any(|w| w == what);
    if holds(b".usda") || holds(b".usdc") {
        return FileKind { name: "a USDZ file", advice: BLENDER };
    }
    if holds(b"3dmodel") || holds(b"3D/") {
        return FileKind { name: "a 3MF file", advice: MESHLAB };
    }
    FileKind { name: "a zip archive", advice: UNPACK }
}

fn json(start: &str) -> FileKind {
    let kind = |name, advice| FileKind { name, advice };
    let has = |what: &str| start.contains(what);
    if has("\"CityJSON\"") {
        return kind("a CityJSON model", "convert it with cjio: `cjio model.json export glb model.glb`");
    }
    if has("\"geometricError\"") {
        return kind("a 3D Tiles tileset", "name one of the .glb files of its tiles");
    }
    if has("\"FeatureCollection\"") {
        return kind("a GeoJSON file", UNKNOWN);
    }
    if has("\"metadata\"") && has("\"Object\"") {
        return kind("a three.js scene", "export it from the three.js editor as GLB");
    }
    if has("\"asset\"") && (has("\"accessors\"") || has("\"meshes\"") || has("\"scenes\"")) {
        return FileKind::GLTF;
    }
    FileKind::JSON
}

fn is_spec(text: &str) -> bool {
    let heads = ["[scene]", "[camera]", "[[lens]]", "[image]", "[[overlap]]", "[light]", "[scene.alternates]"];
    text.lines().any(|line| heads.contains(&line.split('#').next().unwrap_or_default().trim()))
}

/// Some lines of three numbers behind a `v`, or the names of OBJ's other statements.
fn is_obj(text: &str) -> bool {
    let is_vertex = |line: &str| {
        let mut words = line.split_whitespace();
        words.next() == Some("v") && words.take(3).filter(|w| w.parse::<f64>().is_ok()).count() == 3
    };
    text.lines().any(|line| is_vertex(line) || line.starts_with("mtllib ") || line.starts_with("usemtl "))
}

/// The beginning, where it is text.
fn text(bytes: &[u8]) -> Option<String> {
    let head = &bytes[..bytes.len().min(LOOKED_AT)];
    let is_control = |b: &u8| *b < 32 && !matches!(b, b'\n' | b'\r' | b'\t' | 12);
    (!head.iter().any(is_control)).then(|| String::from_utf8_lossy(head).replace('\r', ""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_by_their_first_bytes() {
        let mut stl = vec![b' '; 84];
        stl[..5].copy_from_slice(b"solid");
        stl[80..84].copy_from_slice(&1u32.to_le_bytes());
        stl.extend([0; 50]);
        let dicom = [&[0; 128][..], b"DICM"].concat();
        let cases: &[(&[u8], &str)] = &[
            (b"", "an empty file"),
            (b"\0\x01\x02", "not a file of a kind that is known here"),
            (b"hello", "a text that is no model"),
            (b"# a cube\no cube\nv 0.5 -0.5 1e0\nf 1 2 3\n", "an OBJ file"),
            (b"ply\r\nformat ascii 1.0\r\n", "a PLY file"),
            (b"solid cube\n facet normal 0 0 1\n", "an STL file"),
            (&stl, "an STL file"),
            (b"Kaydara FBX Binary  \0", "an FBX file"),
            (b"; FBX 7.4.0 project file\n", "an FBX file"),
            (b"#usda 1.0\n", "a USD file"),
            (b"PK\x03\x04\x14\0\0\0\0\0chair.usdc", "a USDZ file"),
            (b"PK\x03\x04\x14\0\0\0\0\0notes.txt", "a zip archive"),
            (b"ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\n", "an IFC model"),
            (b"ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\n", "a STEP file"),
            (b"LASF\0\0", "a LAS or LAZ point cloud"),
            (b"# vtk DataFile Version 3.0\n", "a VTK file"),
            (b"<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">", "a VTK file"),
            (b"<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"\">", "a COLLADA file"),
            (b"<!DOCTYPE html>\n<html>", "a web page"),
            (b"version https://git-lfs.github.com/spec/v1\n", "a Git LFS pointer, not the file itself"),
            (b"\x89PNG\r\n\x1a\n", "a PNG image"),
            (b"RIFF\0\0\0\0WEBPVP8 ", "a WebP image"),
            (b"{\"type\": \"CityJSON\"}", "a CityJSON model"),
            (b"{\"type\": \"FeatureCollection\"}", "a GeoJSON file"),
            (b"{}", "JSON that is not glTF"),
            (b"version = 1\n\n[scene] # the model\nfile = \"a.glb\"\n", "a lens spec"),
            (b"[scene]\nfile = \"a.glb\"\n", "a lens spec"),
            (&dicom, "a DICOM image"),
        ];
        for (bytes, name) in cases {
            assert_eq!(FileKind::of(bytes).name, *name, "{}", String::from_utf8_lossy(bytes));
        }
    }
}
