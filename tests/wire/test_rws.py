"""RWS bodies, forms, paths and logins, as recorded from controllers."""

import hashlib
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidgen.wire.rws import events, json_bodies, login, media, xhtml
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Body, Fault, Generation, Item, Unreadable
from rapidgen.wire.rws.forms import read_form, split_target, write_form

PANEL = Item("pnl-ctrlstate", "ctrlstate", {"ctrlstate": "motoroff"})

# -- bodies as they were captured: names and order of a RobotWare 6.16 and a 7.21 ------------------

XHTML_1 = (
    b'<html><head><title>rw</title><base href="http://h/rw/panel/"/></head><body>'
    b'<div class="state"><a href="" rel="self"/><ul><li class="pnl-ctrlstate" title="ctrlstate">'
    b'<span class="ctrlstate">motoroff</span></li></ul></div></body></html>'
)
XHTML_FAULT_1 = (
    b'<html><head><title>rw</title></head><body><div class="status"><span class="code">'
    b'-1073445862</span><span class="msg">file.cpp[12] text code:-1073445862 icode:-1</span></div>'
    b"</body></html>"
)
JSON_1 = (
    b'{"_links":{"base":{"href":"http://h/"}},"_embedded":{"_state":[{"_type":"pnl-ctrlstate",'
    b'"_title":"ctrlstate","ctrlstate":"motoroff"}]}}'
)
JSON_FAULT_1 = (
    b'{"_links":{"base":{"href":"http://h/"}},"_embedded":{"status":{"code":-1073445862,'
    b'"msg":"file.cpp[12] text code:-1073445862 icode:-1"},"_state":[]}}'
)
HAL_2 = (
    b'{"_links":{"base":{"href":"https://h/rw/"},"self":{"href":"signals"},"next":{"href":'
    b'"signals?start=100&amp;limit=100"}},"status":{"code":294912},"_embedded":{"resources":[{'
    b'"_links":{"self":{"href":"signals/a"}},"_type":"ios-signal-li","_title":"a","lvalue":"1"}]}}'
)
HAL_FAULT_2 = (
    b'{"_links":{"base":{"href":"https://h/"}},"status":{"code":-1073445862,'
    b'"msg":"file.cpp[12] text code:-1073445862 icode:-1"}}'
)
SIGNAL = "/rw/iosystem/signals/a;state"
FAULT = Fault(-1073445862, "file.cpp[12] text code:-1073445862 icode:-1")


def test_captured_bodies_are_read():
    assert xhtml.read(XHTML_1).items == (PANEL,)
    assert xhtml.read(XHTML_1).base == "http://h/rw/panel/"
    assert json_bodies.read(JSON_1).items == (PANEL,)
    hal = json_bodies.read(HAL_2)
    assert hal.next == "signals?start=100&limit=100"
    assert hal.items[0].links == {"self": "signals/a"}
    assert hal.items[0].text("lvalue") == "1"
    assert hal.fault is None


@pytest.mark.parametrize(
    ("read", "data"),
    [
        (xhtml.read, XHTML_FAULT_1),
        (json_bodies.read, JSON_FAULT_1),
        (json_bodies.read, HAL_FAULT_2),
    ],
)
def test_captured_refusals_are_read(read, data):
    assert read(data).fault == FAULT


def test_written_bodies_have_the_captured_shape():
    body = Body((PANEL,), title="rw", base="http://h/rw/panel/")
    assert b'<li class="pnl-ctrlstate" title="ctrlstate"><span class="ctrlstate">' in xhtml.write(
        body
    )
    assert json_bodies.write_json(Body((PANEL,), base="http://h/")).replace(b" ", b"") == JSON_1
    refused = json_bodies.write_json(Body(base="http://h/", fault=FAULT))
    assert refused.replace(b": ", b":").replace(b", ", b",") != JSON_FAULT_1  # order of members
    assert json_bodies.read(refused) == json_bodies.read(JSON_FAULT_1)
    hal = json_bodies.write_hal(Body(base="https://h/", fault=FAULT))
    assert json_bodies.read(hal) == json_bodies.read(HAL_FAULT_2)
    assert b"<title>" not in xhtml.write(Body(fault=FAULT))


def test_robotware_6_writes_a_class_with_a_blank():
    body = xhtml.read(
        b'<html><li class="pnl-coldetstate"><span class="coldetstate ">INIT</span></li></html>'
    )
    assert body.items[0].text("coldetstate") == "INIT"


texts = st.text(st.characters(codec="utf-8", exclude_categories=("Cc", "Cs")), max_size=12)
names = st.from_regex(r"[a-z][a-z0-9-]{0,8}", fullmatch=True).filter(lambda n: n != "status")
items = st.builds(
    Item,
    names,
    texts,
    st.dictionaries(names, texts, max_size=3),
    within=st.lists(st.builds(Item, names, texts), max_size=2).map(tuple),
)


@given(st.lists(items, max_size=3).map(tuple))
def test_written_bodies_are_read_back(result):
    body = Body(result, title="rw", base="https://h/", here="x")
    assert [(i.kind, i.title, dict(i.fields)) for i in xhtml.read(xhtml.write(body)).items] == [
        (i.kind, i.title, {k: v for k, v in i.fields.items()}) for i in result
    ]
    assert json_bodies.read(json_bodies.write_hal(body)).items == result
    assert json_bodies.read(json_bodies.write_json(body)).items == result


@given(st.one_of(st.binary(max_size=80), st.sampled_from([XHTML_1, HAL_2]).flatmap(
    lambda whole: st.integers(0, len(whole)).map(lambda n: whole[:n]))),
    st.sampled_from(["application/json", "application/xhtml+xml", ""]))  # fmt: skip
def test_hostile_answers_are_read_or_refused(data, kind):
    with suppress(Unreadable):
        assert isinstance(media.read(data, kind), Body)


@pytest.mark.parametrize(
    "data",
    [
        b'<!DOCTYPE x [<!ENTITY a "b"><!ENTITY c "&a;&a;">]><html>&c;</html>',
        b'<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/passwd">]><html>&a;</html>',
        b"<html>" + b"<li>" * 5000,
        b"<html>" + b"<ul><li>" * 20 + b"</li></ul>" * 20 + b"</html>",
        b"[" * 100_000,
        b'{"_embedded":[],"status":{"code":"x"}}',
    ],
)
def test_bodies_that_are_traps_are_refused(data):
    with pytest.raises(Unreadable):
        media.read(data, "")


# -- forms, paths ----------------------------------------------------------------------------------


def test_forms_go_both_ways():
    assert write_form({"value": '"a b&c"', "x": "[1,2]"}) == b"value=%22a%20b%26c%22&x=%5B1%2C2%5D"
    assert read_form(b"Access=[All,1]&Label=a+b%20c") == [("Access", "[All,1]"), ("Label", "a b c")]


def test_paths_keep_dollars_and_semicolons():
    assert split_target("/fileservice/$HOME/a%20b.mod?json=1") == (
        "/fileservice/$HOME/a b.mod", "", [("json", "1")],
    )  # fmt: skip
    assert split_target("/rw/rapid/symbol/data/RAPID%2FT%2Fx;value") == (
        "/rw/rapid/symbol/data/RAPID/T/x", "value", [],
    )  # fmt: skip
    # A semicolon that is encoded belongs to a name.
    assert split_target("/rw/iosystem/signals/a%3Bb;state")[:2] == (
        "/rw/iosystem/signals/a;b", "state",
    )  # fmt: skip
    route = ops.SIGNAL.route(Generation.ONE)
    assert (
        route.fill({"signal": "Local/DRV_1/a b;c"}) == "/rw/iosystem/signals/Local/DRV_1/a%20b%3Bc"
    )
    assert ops.READ_FILE.route(Generation.ONE).fill({"path": "$HOME/a"}) == "/fileservice/$HOME/a"


@pytest.mark.parametrize("target", ["", "x", "/%zz", "/a%00b", "/%ff"])
def test_invalid_path_is_refused(target):
    with pytest.raises(Unreadable):
        split_target(target)


def test_generations_spell_operations_differently():
    spelled = [
        [
            None if r is None else f"{r.method} {r.fill({'task': 'T', 'domain': 'edit'})}"
            for r in rows
        ]
        for rows in (
            [operation.route(g) for g in Generation]
            for operation in (ops.LOAD_MODULE, ops.SET_SPEED, ops.REQUEST, ops.WRITE_REQUEST)
        )
    ]
    assert spelled == [
        ["POST /rw/rapid/tasks/T?action=loadmod", *["POST /rw/rapid/tasks/T/loadmod"] * 2],
        ["POST /rw/panel/speedratio?action=setspeedratio"] * 3,
        ["POST /rw/mastership/edit?action=request", *["POST /rw/mastership/edit/request"] * 2],
        [None, None, "POST /rw/controlstation/writeaccess/request"],
    ]


# -- logins, subscriptions -------------------------------------------------------------------------


def test_a_digest_is_checked_as_rfc_7616_says():
    def md5(text):
        return hashlib.md5(text.encode()).hexdigest()

    ha1 = md5(f"Default User:{login.REALM}:robotics")
    uri = "/rw/rapid/symbol/data/RAPID/T/x;value?json=1"
    response = md5(f"{ha1}:n:00000001:c:auth:{md5(f'GET:{uri}')}")
    header = (
        f'Digest username="Default User", realm="{login.REALM}", nonce="n", uri="{uri}", '
        f'qop=auth, nc=00000001, cnonce="c", response="{response}"'
    )
    sent = login.parse(header)
    assert login.is_right(sent, "GET", "robotics")
    assert not login.is_right(sent, "POST", "robotics")
    assert not login.is_right(sent, "GET", "robotic")


@given(st.text(max_size=60))
def test_hostile_authorization_is_refused(text):
    assert login.basic_user(text, {"a": "b"}) is None
    assert login.parse(f"Digest {text}") is None


def test_subscription_request_and_event_round_trip():
    wanted = [
        events.WantedResource("/rw/panel/opmode", 1),
        events.WantedResource("/rw/iosystem/signals/a;state", 2),
    ]
    assert events.read_wanted(read_form(write_form(events.write_wanted(wanted)))) == wanted
    # Indices from 0, one `resources` for all, `;` as %3B: public clients do so.
    odd = read_form(b"resources=0&0=/rw/iosystem/signals/a%3Bstate&0-p=2")
    assert events.read_wanted(odd) == [wanted[1]]
    event = Item(
        "ios-signalstate-ev", "a", {"lvalue": "1"}, {"self": "/rw/iosystem/signals/a;state"}
    )
    data = events.write_events([event])
    assert b"\n" not in data
    assert events.read_events(data) == (event,)
    opened = events.write_opened(4, "ws://h/poll/4", [event])
    # A public client's regular expression wants an open and a close tag here.
    assert b'<a href="ws://h/poll/4" rel="self"></a>' in opened
    assert events.read_opened(xhtml.read(opened), "wss://elsewhere:1/poll/4") == ("4", "/poll/4")
