"""Files that are read are recorded, also through what is kept in memory."""

from softgrip.reads import recorded, remembered


def files(tmp_path):
    names = ("one", "two")
    for name in names:
        (tmp_path / name).write_text(name)
    return [(tmp_path / name).resolve() for name in names]


def test_what_is_opened_for_reading_is_recorded_and_nothing_else(tmp_path):
    one, two = files(tmp_path)
    two.read_text()
    with recorded() as seen:
        one.read_bytes()
        two.write_text("again")
    two.read_text()
    assert seen == {one}


def test_each_record_has_what_the_records_within_it_have(tmp_path):
    one, two = files(tmp_path)
    with recorded() as outer:
        one.read_text()
        with recorded() as inner:
            two.read_text()
    assert (outer, inner) == ({one, two}, {two})


def test_result_from_memory_counts_as_read_again_also_through_others(tmp_path):
    one, two = files(tmp_path)
    calls = []

    @remembered
    def read(path):
        calls.append(path)
        return path.read_text()

    @remembered
    def both():
        return read(one) + read(two)

    assert (read(one), both(), both()) == ("one", "onetwo", "onetwo")
    with recorded() as seen:
        assert both() == "onetwo"
    assert seen == {one, two}
    with recorded() as seen:
        read(two)
    assert seen == {two}
    assert calls == [one, two]
    read.cache_clear()
    assert (read(one), calls) == ("one", [one, two, one])


def test_record_ends_where_an_error_passes(tmp_path):
    one, _ = files(tmp_path)
    try:
        with recorded() as seen:
            raise ValueError
    except ValueError:
        one.read_text()
    assert seen == set()
