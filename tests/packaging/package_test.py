"""package_test.py SOURCE_FOLDER BUILD_FOLDER CPACK VERSION: the Debian package is what it should be. It is built of what has been
built, judged by lintian, unpacked, and what is in it is tried without installing it."""
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE, BUILD = map(pathlib.Path, sys.argv[1:3])
CPACK, VERSION = sys.argv[3:5]
del sys.argv[1:5]
NEEDED = ("dpkg-deb", "dpkg-shlibdeps", "lintian", "man", "desktop-file-validate", "update-mime-database", "appstreamcli", "fish", "zsh")


def run(*words, **options):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, stdin=subprocess.DEVNULL, **options)


def group(name):
    """The packages of a group of packages.txt."""
    text = (SOURCE / "packages.txt").read_text()
    lines = text.split(f"[{name}]\n")[1].split("\n[")[0].splitlines()
    return [line for line in lines if line and not line.startswith("#")]


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="acentric-package-")
        cls.addClassCleanup(folder.cleanup)
        cls.work = pathlib.Path(folder.name)
        # Packed fast, since it is unpacked at once.
        packed = run(CPACK, "-G", "DEB", "--config", BUILD / "CPackConfig.cmake", "-B", cls.work, "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip")
        packages = list(cls.work.glob("*.deb"))
        if packed.returncode != 0 or len(packages) != 1:
            raise AssertionError(f"cpack made {packages}:\n{packed.stdout}{packed.stderr}")
        cls.package = packages[0]
        cls.root = cls.work / "root"
        subprocess.run(["dpkg-deb", "-x", cls.package, cls.root], check=True)
        cls.share = cls.root / "usr/share"
        cls.home = cls.work / "home"
        cls.home.mkdir()

    def program(self, name, *words):
        environment = {"HOME": str(self.home), "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}
        return run(self.root / "usr/bin" / name, *words, env=environment, cwd=self.home)

    def commands(self, *group):
        """As the program's own help lists them."""
        told = self.program("acentric", *group, "--help").stdout
        return re.findall(r"^  ([a-z][a-z-]*)  ", told.split("Subcommands:")[1].split("Examples:")[0], re.MULTILINE)

    def pages(self):
        return ["acentric", "acentric-editor"] + [f"acentric-{command}" for command in self.commands()]

    def test_control_says_what_it_needs(self):
        control = run("dpkg-deb", "-f", self.package).stdout
        fields = dict(re.findall(r"^(\S+): (.*(?:\n .*)*)", control, re.MULTILINE))
        self.assertEqual(fields["Package"], "acentric")
        self.assertEqual(fields["Version"], f"{VERSION}-1")
        self.assertEqual(fields["Section"], "graphics")
        needed = [name.split(" ")[0] for name in fields["Depends"].split(", ")]
        for name in group("run") + ["libc6", "libembree3-3", "libopenimageio2.4"]:
            self.assertIn(name, needed)
        self.assertFalse([name for name in needed if name.endswith("-dev")])

    def test_lintian_finds_no_errors(self):
        told = run("lintian", "--no-cfg", "--allow-root", "--fail-on", "error,warning", self.package)
        self.assertEqual(told.returncode, 0, told.stdout + told.stderr)

    def test_files_are_these(self):
        files = {str(file.relative_to(self.root / "usr")) for file in self.root.rglob("*") if not file.is_dir()}
        expected = {"bin/acentric", "bin/acentric-editor"}
        expected |= {f"libexec/acentric/{name}" for name in ("acentric-importer", "acentric-image-files.so")}
        expected |= {f"share/acentric/web/{name}" for name in ("index.html", "viewer.css", "viewer.js")}
        expected |= {f"share/acentric/sample/{name}" for name in ("gallery.acentric.json", "gallery.glb")}
        expected |= {f"share/acentric/sample/paths/{path.name}" for path in (SOURCE / "projects/gallery/paths").iterdir()}
        expected |= {f"share/locale/{language}/LC_MESSAGES/acentric.mo" for language in (SOURCE / "po/LINGUAS").read_text().split()}
        expected |= {f"share/icons/hicolor/{size}x{size}/apps/acentric.png" for size in (16, 24, 32, 48, 64, 128, 256)}
        expected |= {"share/icons/hicolor/scalable/apps/acentric.svg", "share/applications/acentric-editor.desktop",
                     "share/mime/packages/acentric.xml", "share/lintian/overrides/acentric", "share/metainfo/acentric-editor.metainfo.xml"}
        expected |= {f"share/man/man1/{page}.1.gz" for page in self.pages()}
        for name in ("acentric", "acentric-editor"):
            expected |= {f"share/bash-completion/completions/{name}", f"share/fish/vendor_completions.d/{name}.fish",
                         f"share/zsh/vendor-completions/_{name}"}
        expected |= {f"share/doc/acentric/{name}" for name in ("copyright", "changelog.gz", "changelog.Debian.gz")}
        self.assertEqual(sorted(files), sorted(expected))
        for file in files:
            mode = (self.root / "usr" / file).stat().st_mode & 0o777
            self.assertEqual(mode, 0o644 if file.startswith("share/") or file.endswith(".so") else 0o755, file)

    def test_programs_run_where_they_are_unpacked(self):
        self.assertEqual(self.program("acentric", "--version").stdout.strip(), VERSION)
        self.assertEqual(self.program("acentric-editor", "--help").returncode, 0)
        # The importer is found beside the program, and finds the libraries that it needs.
        model = self.share / "acentric/sample/gallery.glb"
        made = self.program("acentric", "new", model, "-o", "new.acentric.json", "--no-estimate")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertIn("cameras", made.stdout)
        # The sample opens, and the page for browsers is found from the program.
        shutil.copytree(self.share / "acentric/sample", self.home / "sample")
        checked = self.program("acentric", "info", "sample/gallery.acentric.json")
        self.assertEqual(checked.returncode, 0, checked.stderr)
        exported = self.program("acentric", "export", "new.acentric.json", "page", "--to", "web", "--allow-missing")
        self.assertEqual(exported.returncode, 0, exported.stderr)
        self.assertTrue((self.home / "page/viewer.js").is_file())

    def test_manual_pages_say_what_the_help_says(self):
        pages = self.pages()
        self.assertGreater(len(pages), 20)
        for page in pages:
            file = self.share / f"man/man1/{page}.1.gz"
            shown = run("man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", file, env=os.environ | {"MANWIDTH": "100", "MANROFFSEQ": ""})
            self.assertEqual((shown.returncode, shown.stderr), (0, ""), page)
            text = re.sub(r".\x08|\x1b\[[0-9;]*m", "", shown.stdout)
            help = self.program(*page.split("-", 1), "--help") if page.startswith("acentric-") and page != "acentric-editor" \
                else self.program(page, "--help")
            self.assertEqual(help.returncode, 0, page)
            options = set(re.findall(r"^ +(?:-\w,)?(--[\w-]+)", help.stdout, re.MULTILINE))
            self.assertTrue(options)
            if "Subcommands:" in help.stdout and page != "acentric":
                for command in self.commands(page.removeprefix("acentric-")):
                    below = self.program("acentric", page.removeprefix("acentric-"), command, "--help").stdout
                    options |= set(re.findall(r"^ +(?:-\w,)?(--[\w-]+)", below, re.MULTILINE))
            for option in options:
                self.assertRegex(text, rf"(?m)^ +(-\w, )?{option}\b", page)
            source = gzip.decompress(file.read_bytes())
            self.assertEqual(source[:3], b".TH")

    def bash(self, *words, name="acentric", here=None):
        """What bash offers in place of the last word."""
        quoted = " ".join(f"'{word}'" for word in words)
        script = f"source '{self.share}/bash-completion/completions/{name}'\nset -u\nCOMP_WORDS=({name} {quoted})\n" \
                 f"COMP_CWORD={len(words)}\n_{name.replace('-', '_')}\nprintf '%s\\n' \"${{COMPREPLY[@]}}\""
        told = run("bash", "--norc", "-c", script, cwd=here or self.home)
        self.assertEqual((told.returncode, told.stderr), (0, ""), words)
        return told.stdout.split()

    def test_bash_completes(self):
        self.assertEqual(self.bash("ba"), ["bake"])
        self.assertEqual(sorted(self.bash("")), sorted(self.commands()))
        self.assertEqual(sorted(self.bash("bench", "")), sorted(self.commands("bench")))
        self.assertEqual(self.bash("bake", "--quality", ""), ["preview", "draft", "final"])
        self.assertEqual(self.bash("bake", "--quality", "=", "pre"), ["preview"])
        self.assertEqual(self.bash("bake", "p.acentric.json", "--qual"), ["--quality"])
        self.assertEqual(self.bash("bake", "--thr"), ["--threads"], "options of all commands, after any")
        self.assertEqual(self.bash("--threads", "2", "ba"), ["bake"])
        self.assertEqual(self.bash("--threads", ""), [])
        here = self.work / "complete"
        (here / "folder").mkdir(parents=True)
        for name in ("a.acentric.json", "b.acentric", "c.glb"):
            (here / name).touch()
        self.assertEqual(self.bash("bake", "", here=here), ["a.acentric.json", "folder"])
        self.assertEqual(self.bash("bake", "--threads", "2", "", here=here), ["a.acentric.json", "folder"])
        self.assertEqual(self.bash("render", "", here=here), ["a.acentric.json", "b.acentric", "folder"])
        self.assertEqual(self.bash("new", "c", here=here), ["c.glb"])
        self.assertEqual(self.bash("bake", "c", here=here), ["c.glb"], "any file where there is no project")
        self.assertEqual(self.bash("export", "a.acentric.json", "fo", here=here), ["folder"])
        self.assertEqual(self.bash("bench", "growth", "x", "y", "a", here=here), ["a.acentric.json"])
        self.assertEqual(self.bash("--siz", name="acentric-editor"), ["--size"])

    def test_fish_completes(self):
        def fish(line):
            script = self.share / "fish/vendor_completions.d/acentric.fish"
            told = run("fish", "--no-config", "-c", f"source {script}; complete -C '{line}'", env=os.environ | {"HOME": str(self.home)},
                       cwd=self.work)
            self.assertEqual((told.returncode, told.stderr), (0, ""), line)
            return [line.split("\t")[0] for line in told.stdout.splitlines()]
        self.assertIn("bake", fish("acentric ba"))
        self.assertEqual(sorted(fish("acentric bench ")), sorted(self.commands("bench")))
        self.assertEqual(fish("acentric bake --quality "), ["draft", "final", "preview"])
        self.assertEqual(fish("acentric bake --qual"), ["--quality"])
        self.assertIn("--stream", fish("acentric bench view --"))
        self.assertNotIn("--quality", fish("acentric bench bake --"), "those of the other command bake")

    def test_zsh_can_read_its_completion(self):
        for name in ("_acentric", "_acentric-editor"):
            told = run("zsh", "-n", self.share / "zsh/vendor-completions" / name)
            self.assertEqual((told.returncode, told.stderr), (0, ""))

    def test_desktop_knows_program_and_files(self):
        entry = self.share / "applications/acentric-editor.desktop"
        told = run("desktop-file-validate", entry)
        self.assertEqual((told.returncode, told.stdout + told.stderr), (0, ""))
        told = run("appstreamcli", "validate", "--no-net", "--no-color", self.share / "metainfo/acentric-editor.metainfo.xml").stdout
        self.assertIn("alidation", told)
        # Names of the kind org.example.Program need a domain.
        self.assertEqual([line for line in re.findall("(?m)^[EW]: .*", told) if "cid-desktopapp-is-not-rdns" not in line], [])
        mime = self.work / "mime"
        shutil.copytree(self.share / "mime", mime)
        told = run("update-mime-database", "-V", mime)
        self.assertEqual(told.returncode, 0, told.stdout + told.stderr)
        globs = (mime / "globs2").read_text()
        self.assertIn("80:application/x-acentric-project+json:*.acentric.json", globs)
        self.assertIn("50:application/x-acentric-walk:*.acentric", globs)
        self.assertIn("application/x-acentric-project+json application/json", (mime / "subclasses").read_text())
        for kind in re.findall(r'type="(application/x-acentric[^"]*)"', (mime / "packages/acentric.xml").read_text()):
            self.assertIn(kind, entry.read_text())


if __name__ == "__main__":
    missing = [tool for tool in NEEDED if not shutil.which(tool)]
    if missing:
        print(f"skipped: {', '.join(missing)} not installed")
        sys.exit(77)
    unittest.main()
